#include "interpreter/stock/stock_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "interpreter/solids/clearance.h"
#include "interpreter/text/hash.h"

// All numbers are little endian, floats are IEEE 754:
//
//   "isostock"   8 bytes
//   version      u32
//   columns      u32
//   rows         u32
//   bounds       6 f64: smallest x, y, z, largest x, y, z. The grid is grid_of(bounds, columns, rows).
//   tiles        row by row, as many as the grid has
//   check sum    u64: text::hash_on() of all bytes before it
//
// A tile is one of:
//
//   0, f32 bottom, f32 top    All dexels are the same. Without material, both are equal.
//   1, heights, heights,      Lower and upper end of the highest interval of each dexel, row by row; both are equal
//      u32 count, further     where there is no material. Then the further intervals by row, by column, and from the
//                             lowest up: u8 row, u8 column, f32 bottom, f32 top.
//
// Heights are f32 in packets: i16 n, then n floats, or, where n is negative, one float that counts -n times.

namespace isocnc::stock {

using FileProblem = StockFileProblem::Kind;

namespace {

constexpr std::string_view kMagic = "isostock";
constexpr std::uint32_t kVersion = 2;  // 1 had no check sum.
constexpr std::size_t kSmallestTile = 9;
static_assert(Tile::kSize * Tile::kSize <= 32767, "A packet may hold all heights of a tile.");
constexpr std::size_t kSmallestRun = 3;  ///< Shorter runs are written as other heights.

class Writer {
 public:
  void write(std::string_view bytes) { bytes_ += bytes; }
  void write_u8(std::size_t value) { write_integer(value, 1); }
  void write_u16(std::size_t value) { write_integer(value, 2); }
  void write_u32(std::size_t value) { write_integer(value, 4); }
  void write_u64(std::uint64_t value) { write_integer(value, 8); }
  void write_f32(float value) { write_integer(std::bit_cast<std::uint32_t>(value), 4); }
  void write_f64(double value) { write_integer(std::bit_cast<std::uint64_t>(value), 8); }

  void write_heights(const std::vector<float>& heights) {
    std::size_t others = 0;  // Start of the heights that are in no packet yet.
    for (std::size_t i = 0; i < heights.size();) {
      std::size_t end = i + 1;
      while (end < heights.size() && heights[end] == heights[i]) ++end;
      if (end - i >= kSmallestRun) {
        write_others(heights, others, i);
        write_u16(0x10000 - (end - i));
        write_f32(heights[i]);
        others = end;
      }
      i = end;
    }
    write_others(heights, others, heights.size());
  }

  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }

 private:
  void write_integer(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xFF);
  }
  void write_others(const std::vector<float>& heights, std::size_t first, std::size_t last) {
    if (first == last) return;
    write_u16(last - first);
    for (std::size_t i = first; i < last; ++i) write_f32(heights[i]);
  }

  std::string bytes_;
};

void write_tile(const Tile& tile, Writer& out) {
  if (tile.is_uniform()) {
    out.write_u8(0);
    out.write_f32(tile.floor());
    out.write_f32(tile.ceiling());
    return;
  }
  std::vector<float> bottoms;
  std::vector<float> tops;
  std::vector<DexelInterval> further;
  float empty = 0;  // The last lower end, so that runs go on where there is no material.
  const auto fill_up = [&](int dexels) {
    bottoms.resize(static_cast<std::size_t>(dexels), empty);
    tops.resize(static_cast<std::size_t>(dexels), empty);
  };
  for (int row = 0; row < tile.rows(); ++row)
    tile.for_each_interval(row, [&](int column, float bottom, float top) {
      const int dexel = row * tile.columns() + column;
      if (bottoms.size() == static_cast<std::size_t>(dexel) + 1) {
        further.push_back({row, column, bottoms.back(), tops.back()});
      } else {
        fill_up(dexel + 1);
      }
      empty = bottom;
      bottoms.back() = bottom;
      tops.back() = top;
    });
  fill_up(tile.rows() * tile.columns());
  out.write_u8(1);
  out.write_heights(bottoms);
  out.write_heights(tops);
  out.write_u32(further.size());
  for (const DexelInterval& interval : further) {
    out.write_u8(static_cast<std::size_t>(interval.row));
    out.write_u8(static_cast<std::size_t>(interval.column));
    out.write_f32(interval.bottom);
    out.write_f32(interval.top);
  }
}

/// Reads until something is wrong; from then on, gives zeros.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  const std::optional<StockFileProblem>& problem() const { return problem_; }
  bool is_usable() const { return !problem_; }
  std::size_t offset() const { return at_; }
  std::size_t left() const { return bytes_.size() - at_; }
  void fail(FileProblem kind, std::size_t offset) {
    if (!problem_) problem_ = StockFileProblem{.kind = kind, .offset = offset};
  }

  std::string_view read(std::size_t size) {
    if (left() < size) fail(FileProblem::Truncated, bytes_.size());
    if (!is_usable()) return {};
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  std::uint32_t read_u8() { return static_cast<std::uint32_t>(read_integer(1)); }
  std::uint32_t read_u32() { return static_cast<std::uint32_t>(read_integer(4)); }
  std::uint64_t read_u64() { return read_integer(8); }
  std::string_view read_so_far() const { return bytes_.substr(0, at_); }
  std::int16_t read_i16() { return std::bit_cast<std::int16_t>(static_cast<std::uint16_t>(read_integer(2))); }
  /// A value in [low, high].
  float read_f32(float low, float high) {
    const std::size_t start = at_;
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(read_integer(4)));
    if (!(value >= low && value <= high)) fail(FileProblem::ImpossibleValue, start);
    return is_usable() ? value : 0;
  }
  double read_f64(double low, double high) {
    const std::size_t start = at_;
    const auto value = std::bit_cast<double>(read_integer(8));
    if (!(value >= low && value <= high)) fail(FileProblem::ImpossibleValue, start);
    return is_usable() ? value : 0;
  }
  int read_count(int high) {
    const std::size_t start = at_;
    const std::uint32_t value = read_u32();
    if (value >= 1 && value <= static_cast<std::uint32_t>(high)) return static_cast<int>(value);
    fail(FileProblem::ImpossibleValue, start);
    return 1;
  }

  void read_heights(std::size_t size, float low, float high, std::vector<float>& heights) {
    heights.clear();
    while (heights.size() < size && is_usable()) {
      const std::size_t start = at_;
      const int packet = read_i16();
      const auto count = static_cast<std::size_t>(std::abs(packet));
      if (packet == 0 || count > size - heights.size()) return fail(FileProblem::ImpossibleValue, start);
      if (packet < 0) {
        heights.insert(heights.end(), count, read_f32(low, high));
      } else {
        for (std::size_t i = 0; i < count && is_usable(); ++i) heights.push_back(read_f32(low, high));
      }
    }
  }

 private:
  std::uint64_t read_integer(std::size_t size) {
    std::uint64_t value = 0;
    int shift = 0;
    for (const char byte : read(size)) {
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(byte)) << shift;
      shift += 8;
    }
    return value;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::optional<StockFileProblem> problem_;
};

class StockReader {
 public:
  StockReader(std::string_view bytes, std::size_t memory_limit) : in_(bytes), memory_limit_(memory_limit) {}

  StockOrProblem read() {
    if (in_.left() < kMagic.size() || in_.read(kMagic.size()) != kMagic) in_.fail(FileProblem::NotAStock, 0);
    const std::uint32_t version = in_.read_u32();
    if (version != kVersion) in_.fail(FileProblem::OtherVersion, kMagic.size());
    const int columns = in_.read_count(kMaxDexelsAcross);
    const int rows = in_.read_count(kMaxDexelsAcross);
    const solids::BoundingBox bounds = read_bounds();
    const DexelGrid grid = grid_of(bounds, columns, rows);
    const std::size_t count =
        static_cast<std::size_t>(grid.tile_columns()) * static_cast<std::size_t>(grid.tile_rows());
    if (in_.left() / kSmallestTile < count) in_.fail(FileProblem::Truncated, in_.offset() + in_.left());
    std::vector<std::shared_ptr<Tile>> tiles;
    for (std::size_t i = 0; i < count && in_.is_usable(); ++i) {
      const int across = grid.tile_columns();
      const DexelGrid part = grid.tile(static_cast<int>(i) % across, static_cast<int>(i) / across);
      tiles.push_back(read_tile(part.columns, part.rows));
    }
    check_sum();
    if (in_.left() > 0) in_.fail(FileProblem::TooLong, in_.offset());
    if (in_.is_usable()) return Stock(bounds, columns, rows, std::move(tiles));
    StockFileProblem problem = *in_.problem();
    problem.version = version;
    return problem;
  }

 private:
  /// A value that is possible may be damaged all the same.
  void check_sum() {
    if (!in_.is_usable()) return;
    const std::uint64_t sum = text::hash_on(text::kHashStart, in_.read_so_far());
    const std::size_t start = in_.offset();
    if (in_.read_u64() != sum && in_.is_usable()) in_.fail(FileProblem::Damaged, start);
  }

  solids::BoundingBox read_bounds() {
    solids::BoundingBox bounds;
    for (int i = 0; i < 3; ++i) bounds.min()[i] = in_.read_f64(-solids::kMaxCoordinate, solids::kMaxCoordinate);
    for (int i = 0; i < 3; ++i) bounds.max()[i] = in_.read_f64(bounds.min()[i], solids::kMaxCoordinate);
    low_ = static_cast<float>(bounds.min().z());
    high_ = static_cast<float>(bounds.max().z());
    return bounds;
  }

  std::shared_ptr<Tile> read_tile(int columns, int rows) {
    const std::size_t start = in_.offset();
    const std::uint32_t kind = in_.read_u8();
    if (kind > 1) in_.fail(FileProblem::ImpossibleValue, start);
    std::shared_ptr<Tile> tile = kind == 0 ? read_uniform(columns, rows) : read_material(columns, rows);
    if (tile == last_uniform_) return tile;
    if (tile->is_uniform()) last_uniform_ = tile;
    memory_ += tile->memory();
    if (memory_ > memory_limit_) in_.fail(FileProblem::TooLarge, start);
    return tile;
  }

  std::shared_ptr<Tile> read_uniform(int columns, int rows) {
    const float bottom = in_.read_f32(-kFar, kFar);
    const float top = in_.read_f32(bottom, kFar);
    check_material({0, 0, bottom, top}, in_.offset() - kSmallestTile + 1);
    const Tile* const last = last_uniform_.get();
    if (last && last->columns() == columns && last->rows() == rows && last->floor() == bottom && last->ceiling() == top)
      return last_uniform_;
    return std::make_shared<Tile>(columns, rows, bottom, top);
  }

  std::shared_ptr<Tile> read_material(int columns, int rows) {
    const auto size = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    const std::size_t start = in_.offset();
    in_.read_heights(size, -kFar, kFar, bottoms_);
    in_.read_heights(size, -kFar, kFar, tops_);
    const std::size_t further = in_.read_u32();
    std::vector<DexelInterval> material;
    std::size_t next = 0;  // Dexel that is to be appended.
    const auto append_highest = [&](std::size_t end) {
      for (; next < end; ++next) {
        const auto dexel = static_cast<int>(next);
        if (!(bottoms_[next] <= tops_[next])) return in_.fail(FileProblem::ImpossibleValue, start);
        append({dexel / columns, dexel % columns, bottoms_[next], tops_[next]}, start, material);
      }
    };
    for (std::size_t i = 0; i < further && in_.is_usable(); ++i) {
      const std::size_t at = in_.offset();
      DexelInterval interval;
      interval.row = static_cast<int>(in_.read_u8());
      interval.column = static_cast<int>(in_.read_u8());
      interval.bottom = in_.read_f32(-kFar, kFar);
      interval.top = in_.read_f32(interval.bottom, kFar);
      const auto dexel = static_cast<std::size_t>(interval.row * columns + interval.column);
      if (interval.row >= rows || interval.column >= columns || dexel < next || !(interval.bottom < interval.top))
        in_.fail(FileProblem::ImpossibleValue, at);
      if (!in_.is_usable()) break;
      append_highest(dexel);
      append(interval, at, material);
      // There is always one above it.
      if (!(tops_[dexel] > bottoms_[dexel])) in_.fail(FileProblem::ImpossibleValue, at);
    }
    if (in_.is_usable()) append_highest(size);
    return std::make_shared<Tile>(
        columns, rows, in_.is_usable() ? std::span<const DexelInterval>(material) : std::span<const DexelInterval>());
  }

  void append(const DexelInterval& interval, std::size_t offset, std::vector<DexelInterval>& material) {
    if (!(interval.bottom < interval.top)) return;
    check_material(interval, offset);
    if (!material.empty()) {
      const DexelInterval& last = material.back();
      if (last.row == interval.row && last.column == interval.column && !(last.top <= interval.bottom))
        in_.fail(FileProblem::ImpossibleValue, offset);
    }
    material.push_back(interval);
  }

  /// There is no material outside the bounds.
  void check_material(const DexelInterval& interval, std::size_t offset) {
    if (interval.bottom < interval.top && !(interval.bottom >= low_ && interval.top <= high_))
      in_.fail(FileProblem::ImpossibleValue, offset);
  }

  static constexpr float kFar = 2 * static_cast<float>(solids::kMaxCoordinate);

  Reader in_;
  std::size_t memory_limit_;
  std::size_t memory_ = 0;
  float low_ = 0;
  float high_ = 0;
  std::shared_ptr<Tile> last_uniform_;
  std::vector<float> bottoms_;
  std::vector<float> tops_;
};

}  // namespace

std::string write_stock(const Stock& stock) {
  const DexelGrid& grid = stock.grid();
  Writer out;
  out.write(kMagic);
  out.write_u32(kVersion);
  out.write_u32(static_cast<std::size_t>(grid.columns));
  out.write_u32(static_cast<std::size_t>(grid.rows));
  for (const double value : stock.bounds().min()) out.write_f64(value);
  for (const double value : stock.bounds().max()) out.write_f64(value);
  for (int row = 0; row < grid.tile_rows(); ++row)
    for (int column = 0; column < grid.tile_columns(); ++column) write_tile(stock.tile({column, row}), out);
  out.write_u64(text::hash_on(text::kHashStart, out.bytes()));
  return out.take();
}

StockOrProblem read_stock(std::string_view bytes, std::size_t memory_limit) {
  return StockReader(bytes, memory_limit).read();
}

}  // namespace isocnc::stock
