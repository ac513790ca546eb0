#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace isocnc::protocol {

/// The file that a URI names; nothing if it names none, such as an `untitled:` URI.
std::optional<std::filesystem::path> path_of(std::string_view uri);

/// The name of a file or an untitled document, for people: what stands last in its URI.
std::string name_in(std::string_view uri);

/// Whether a URI names a configuration or the setup of a program, such as `door.setup.json`: files that are no programs
/// although the editor may have them open.
bool names_configuration(std::string_view uri);
/// Whether a URI names an STL file, which a setup may name.
bool names_shape(std::string_view uri);

/// The URI of an absolute path, such as `file:///part%201.iso`.
std::string uri_of(const std::filesystem::path& path);

/// The scheme of texts about a program that the server writes.
inline constexpr std::string_view kTextScheme = "isocnc";

/// A text about a program, as `workspace/textDocumentContent` asks for it.
struct TextAboutProgram {
  std::string kind;                   ///< `state` or `syntax`.
  std::string program;                ///< The URI of the program.
  std::optional<std::uint32_t> line;  ///< From 0; without it, the text is about the whole program.
};

/// Reads `isocnc://state/part.iso.state?line=4&program=file%3A///part.iso`. Nothing if the URI names no text. The path
/// is a title for the reader; the program comes last.
std::optional<TextAboutProgram> read_text_uri(std::string_view uri);
std::string uri_of(const TextAboutProgram& text);

}  // namespace isocnc::protocol
