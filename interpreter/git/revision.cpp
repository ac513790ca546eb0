#include "interpreter/git/revision.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <new>
#include <string_view>
#include <system_error>
#include <vector>

#include "interpreter/dialect/format.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/process.h"
#include "interpreter/system/system_texts.h"

namespace isocnc::git {

namespace fs = std::filesystem;
using dialect::Language;
using dialect::Text;
using system::ProgramEnd;

namespace {

constexpr Text kNoProcesses{"no file has this name, and git cannot be asked here for a revision",
                            "nessun file ha questo nome, e qui non si può chiedere una revisione a git"};
constexpr Text kNoGit{"no file has this name, and git was not found, which would know a revision",
                      "nessun file ha questo nome, e non si trova git, che conoscerebbe una revisione"};
constexpr Text kNotStarted{"git cannot be started: {}", "git non si può avviare: {}"};
constexpr Text kNoRepository{"no file has this name, and git finds no repository: {}",
                             "nessun file ha questo nome, e git non trova un repository: {}"};
constexpr Text kNoRevision{"no file has this name, and git knows no revision {}, or several",
                           "nessun file ha questo nome, e git non conosce una revisione {}, o più d'una"};
constexpr Text kOutside{"is outside of the repository", "è fuori dal repository"};
constexpr Text kNotThere{"{} has no file {}", "in {} non c'è il file {}"};
constexpr Text kNotStaged{"no file {} is staged", "il file {} non è nell'indice"};
constexpr Text kFromHere{"; from the current folder it would be {}", "; dalla cartella corrente sarebbe {}"};
constexpr Text kFolder{"is a directory", "è una directory"};
constexpr Text kSubmodule{"is in a submodule, {}: ask there", "è in un submodule, {}: va chiesto lì"};
constexpr Text kLink{"is a symbolic link to what is not in the revision",
                     "è un collegamento simbolico a qualcosa che non è nella revisione"};
constexpr Text kLineEnd{"has a line end in its name", "ha un fine riga nel nome"};
constexpr Text kGitSays{"git: {}", "git: {}"};

/// What git says of a failure, without its `fatal: ` and its hints.
std::string_view complaint_of(const ProgramEnd& end) {
  std::string_view line = end.errors;
  line = line.substr(0, line.find('\n'));
  for (const std::string_view prefix : {"fatal: ", "error: "})
    if (line.starts_with(prefix)) line.remove_prefix(prefix.size());
  return line;
}

/// One of the answers of `git cat-file --batch-check`: `OBJECT KIND SIZE` for what exists.
struct Answer {
  std::string_view object;
  std::string_view kind;  ///< `blob`, `tree`; or why there is none: `missing`, `ambiguous`, `submodule`, `symlink`.

  explicit Answer(std::string_view line) {
    const std::size_t last = line.rfind(' ');
    if (last == std::string_view::npos) return;
    const std::string_view end = line.substr(last + 1);
    const bool is_counted =
        !end.empty() && std::all_of(end.begin(), end.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    const std::size_t first = line.find(' ');
    if (is_counted && first == last) {  // `symlink 11`, and its target on the next line.
      kind = line.substr(0, last);
    } else if (is_counted && line.find(' ', first + 1) == last && first >= 40) {
      object = line.substr(0, first);
      kind = line.substr(first + 1, last - first - 1);
    } else {  // `HEAD:part.iso missing`
      kind = end;
    }
  }
};

/// Asks git about one file.
class Question {
 public:
  Question(const RevisionFile& file, Language language) : file_(file), language_(language) {}

  std::variant<FileAtRevision, std::string> answer();

 private:
  /// Runs git; none if it fails, with the reason in `problem_`.
  std::optional<std::string> git(std::vector<std::string> arguments, std::string_view input = {},
                                 const Text& failure = kGitSays);
  /// Finds the path from the top of the repository, and the way there.
  bool find_place();
  /// The object that holds the file; none with the reason in `problem_`.
  std::optional<std::string> find_object();
  std::string why_missing(bool has_revision, bool is_here);
  /// The submodule that the path leads into; empty if none.
  std::string submodule();

  template <class... Values>
  void fail(const Text& text, const Values&... values) {
    problem_ = dialect::format(text, language_, values...);
  }

  const RevisionFile& file_;
  const Language language_;
  std::string here_;  // The current folder from the top of the repository, `parts/`; empty at the top.
  std::string path_;  // Of the file, from the top of the repository.
  fs::path place_;
  std::string problem_;
};

std::optional<std::string> Question::git(std::vector<std::string> arguments, std::string_view input,
                                         const Text& failure) {
  arguments.insert(arguments.begin(), "git");
  auto run = system::run_program(arguments, input);
  if (const auto* const error = std::get_if<std::error_code>(&run)) {
    if (*error == std::errc::no_such_file_or_directory) {
      fail(kNoGit);
    } else if (*error == std::errc::function_not_supported) {
      fail(kNoProcesses);
    } else {
      fail(kNotStarted, error->message());
    }
    return std::nullopt;
  }
  auto& end = std::get<ProgramEnd>(run);
  if (end.status == 0) return std::move(end.output);
  fail(failure, complaint_of(end));
  return std::nullopt;
}

bool Question::find_place() {
  // The second line is `../../`; the first one may hold line ends.
  std::optional<std::string> folders = git({"rev-parse", "--show-prefix", "--show-cdup"}, {}, kNoRepository);
  if (!folders) return false;
  while (!folders->empty() && (folders->back() == '\n' || folders->back() == '\r')) folders->pop_back();
  const std::size_t end = folders->rfind("\n../");
  here_ = folders->substr(0, end);
  const fs::path top = end == std::string::npos ? fs::path() : fs::path(folders->substr(end + 1));
  path_ = system::generic_name(fs::path(file_.path));
  if (path_.starts_with("./") || path_.starts_with("../"))
    path_ = system::generic_name(system::normal(fs::path(here_) / path_));
  const std::string straight = system::generic_name(system::normal(fs::path(path_)));
  if (straight == ".." || straight.starts_with("../")) {
    fail(kOutside);
    return false;
  }
  place_ = straight.starts_with(here_) ? fs::path(straight.substr(here_.size())) : top / straight;
  return true;
}

std::optional<std::string> Question::find_object() {
  const std::string from_here = here_ + path_;
  for (const std::string& name : {path_, here_, file_.revision})
    if (name.find('\n') != std::string::npos) {
      fail(kLineEnd);
      return std::nullopt;
    }
  std::string questions = file_.name_of(path_) + '\n';
  questions += file_.revision.empty() ? "\n" : file_.revision + "^{tree}\n";
  questions += file_.name_of(from_here) + '\n';
  // Names come by standard input, where none can be taken for an option.
  const std::optional<std::string> answers = git({"cat-file", "--batch-check", "--follow-symlinks"}, questions);
  if (!answers) return std::nullopt;
  std::vector<std::string_view> lines;
  for (std::string_view rest = *answers; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
    lines.push_back(rest.substr(0, end));
    rest.remove_prefix(end + 1);
  }
  const Answer found(lines.empty() ? std::string_view() : lines[0]);
  if (found.kind == "blob") return std::string(found.object);
  if (found.kind == "tree") {
    fail(kFolder);
  } else if (lines.size() > 2 && (found.kind == "missing" || found.kind == "ambiguous" || found.kind == "submodule")) {
    problem_ = why_missing(file_.revision.empty() || Answer(lines[1]).kind == "tree", Answer(lines[2]).kind == "blob");
  } else {
    fail(kLink);
  }
  return std::nullopt;
}

std::string Question::why_missing(bool has_revision, bool is_here) {
  if (!has_revision) return dialect::format(kNoRevision, language_, file_.revision);
  if (const std::string module = submodule(); !module.empty()) return dialect::format(kSubmodule, language_, module);
  std::string text = file_.revision.empty() ? dialect::format(kNotStaged, language_, path_)
                                            : dialect::format(kNotThere, language_, file_.revision, path_);
  if (is_here && !here_.empty()) text += dialect::format(kFromHere, language_, file_.name_of("./" + path_));
  return text;
}

std::string Question::submodule() {
  constexpr int kDeepest = 100;
  if (file_.revision.empty()) return {};
  // A revision that git knows begins with no minus.
  std::vector<std::string> command = {"ls-tree", "--full-tree", "-z", file_.revision, "--"};
  std::size_t end = 0;
  for (int depth = 0; end != std::string::npos && depth < kDeepest; ++depth) {
    end = path_.find('/', end + 1);
    command.push_back(path_.substr(0, end));
  }
  const std::string entries = git(command).value_or("");
  constexpr std::string_view kModule = "160000 commit ";
  for (std::string_view rest = entries; !rest.empty();) {  // `160000 commit OBJECT`, a tab, a path, and a null.
    const std::string_view entry = rest.substr(0, rest.find('\0'));
    rest.remove_prefix(std::min(entry.size() + 1, rest.size()));
    std::string name(entry.substr(std::min(entry.find('\t'), entry.size() - 1) + 1));
    if (entry.starts_with(kModule) && (path_ + '/').starts_with(name + '/')) return name;
  }
  return {};
}

std::variant<FileAtRevision, std::string> Question::answer() {
  if (!find_place()) return problem_;
  const std::optional<std::string> object = find_object();
  if (!object) return problem_;
  std::optional<std::string> bytes = git({"cat-file", "--filters", "--path=" + path_, *object});
  if (!bytes) return problem_;
  return FileAtRevision{std::move(*bytes), place_};
}

/// Where a revision ends, which may hold `^{/a text: with this}`.
std::size_t find_colon(std::string_view operand) {
  int depth = 0;
  for (std::size_t i = 0; i < operand.size(); ++i) {
    if (operand[i] == '{') ++depth;
    if (operand[i] == '}') --depth;
    if (operand[i] == ':' && depth <= 0) return i;
  }
  return std::string_view::npos;
}

bool is_on_drive(const std::string& operand) {
  if (system::has_root_name(fs::path(operand))) return true;  // On Windows alone.
  return operand.size() > 2 && std::isalpha(static_cast<unsigned char>(operand[0])) != 0 && operand[1] == ':' &&
         (operand[2] == '\\' || operand[2] == '/');
}

}  // namespace

std::string RevisionFile::name_of(const std::string& other_path) const {
  return revision + ':' + (stage.empty() ? "" : stage + ':') + other_path;
}

std::optional<RevisionFile> revision_file(const std::string& operand) {
  const std::size_t colon = find_colon(operand);
  if (colon == std::string::npos || operand[0] == '/' || operand[0] == '.' || is_on_drive(operand)) return std::nullopt;
  std::error_code error;
  if (fs::exists(fs::symlink_status(operand, error))) return std::nullopt;
  RevisionFile file{.revision = operand.substr(0, colon), .stage = {}, .path = operand.substr(colon + 1)};
  if (!file.revision.empty()) return file;
  if (file.path.starts_with('/')) return std::nullopt;  // `:/text` is a commit.
  if (file.path.size() > 1 && file.path[0] >= '0' && file.path[0] <= '3' && file.path[1] == ':') {
    file.stage = file.path.substr(0, 1);
    file.path.erase(0, 2);
  }
  return file;
}

std::variant<FileAtRevision, std::string> read(const RevisionFile& file, Language language) {
  try {
    return Question(file, language).answer();
  } catch (const std::bad_alloc&) {
    return system::cannot_read(ENOMEM, language);
  }
}

}  // namespace isocnc::git
