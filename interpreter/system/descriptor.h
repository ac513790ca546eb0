#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <utility>

/// Open files, pipes and devices by their numbers: those of POSIX, and on Windows those of its C library, all of them
/// without translation of line ends. What fails sets errno.
namespace isocnc::system {

inline constexpr int kStandardInput = 0;
inline constexpr int kStandardOutput = 1;
inline constexpr int kStandardError = 2;

/// A descriptor that the destructor closes; below 0 if nothing has been opened.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor();

  bool is_open() const { return number_ >= 0; }
  int number() const { return number_; }

 private:
  int number_;
};

/// Opens a file, which others may change, rename and remove meanwhile.
Descriptor open_to_read(const std::filesystem::path& path);
/// Likewise, but never waits: a pipe without a writer is read as an empty file.
Descriptor open_to_read_at_once(const std::filesystem::path& path);
/// Opens what exists, or a new file, for appending, so that the text of other writers stays.
Descriptor open_to_append(const std::filesystem::path& path);

enum class Access {
  Usual,    ///< As for any new file of this user.
  Private,  ///< No other user may read it.
};
/// Creates a file. Fails with EEXIST if there is one.
Descriptor create_file(const std::filesystem::path& path, Access access);

/// Reads at most `size` bytes. Returns their number: 0 at the end, below 0 on failure.
std::ptrdiff_t read_some(int descriptor, char* bytes, std::size_t size);
/// Writes at least one byte. Returns the number of those written, below 0 on failure.
std::ptrdiff_t write_some(int descriptor, std::string_view bytes);
/// Waits until all that has been written is on the disk.
bool write_to_disk(int descriptor);

}  // namespace isocnc::system
