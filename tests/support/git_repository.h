#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

namespace isocnc::support {

/// A repository of the real git in a new folder, which knows nothing of the user's settings.
class GitRepository {
 public:
  GitRepository() {
    std::filesystem::create_directory(path());
    must("git init -q -b main");
  }

  std::string path() const { return folder_.path("repository"); }
  std::string path(const std::string& name) const { return path() + "/" + name; }
  std::string write(const std::string& name, std::string_view text) const {
    return folder_.write("repository/" + name, text);
  }
  void commit(const std::string& message) const { must("git add -A . && git commit -q -m '" + message + "'"); }

  /// What has become of a command of the shell.
  struct Done {
    int status = 0;
    std::string out;
    std::string err;
  };
  /// Runs a command of the shell in a folder of the repository, where the programs of the build are found.
  Done run(const std::string& command, const std::string& in = "") const {
    const std::string script = folder_.write("script", kSettings + command + "\n");
    const std::string out = folder_.path("out");
    const std::string err = folder_.path("err");
    const std::string whole = "cd '" + path(in) + "' && env -u GIT_DIR -u GIT_INDEX_FILE -u GIT_WORK_TREE HOME='" +
                              folder_.path() + "' sh '" + script + "' >'" + out + "' 2>'" + err + "' </dev/null";
    const int status = std::system(whole.c_str());
    return {WEXITSTATUS(status), text_of_file(out), text_of_file(err)};
  }
  /// Likewise; throws where the command fails. Returns what it writes.
  std::string must(const std::string& command, const std::string& in = "") const {
    const Done done = run(command, in);
    if (done.status != 0) throw std::runtime_error(command + ": " + done.err);
    return done.out;
  }

 private:
  inline static const std::string kSettings =
      "export GIT_CONFIG_NOSYSTEM=1 GIT_AUTHOR_NAME=Test GIT_AUTHOR_EMAIL=test@localhost GIT_PAGER=cat LC_ALL=C.UTF-8\n"
      "export GIT_COMMITTER_NAME=Test GIT_COMMITTER_EMAIL=test@localhost PATH='" ISOCNC_BIN_DIR
      "':\"$PATH\"\n"
      "unset NO_COLOR GIT_EXTERNAL_DIFF\n";

  TemporaryFolder folder_;
};

}  // namespace isocnc::support
