#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "cuts.h"
#include "interpreter/stock/stock_file.h"
#include "interpreter/text/hash.h"

/// Stocks as bytes and back.
namespace isocnc::stock::cuts {
namespace {

using Kind = StockFileProblem::Kind;

const std::size_t kVersionAt = 8;
const std::size_t kColumnsAt = 12;
const std::size_t kBoundsAt = 20;
const std::size_t kTilesAt = 68;
const std::size_t kSumSize = 8;

/// A plate of four tiles with cuts in some of them, undercuts and holes.
Stock cut_plate() {
  Stock stock(kPlate, 0.7);
  stock.apply(SomeSweeps().make(5, 40));
  const RevolvedBody saw = body(solids::disc_body(15, 3));
  const RevolvedBody drill = flat(6);
  apply(stock, line(saw, {60, 20, -12}, {60, 80, -12}));
  apply(stock, line(drill, {100, 100, -30}, {100, 100, -30}));
  return stock;
}

void expect_round_trip(const Stock& stock) {
  const std::string bytes = write_stock(stock);
  const StockOrProblem read = read_stock(bytes);
  ASSERT_TRUE(std::holds_alternative<Stock>(read)) << static_cast<int>(std::get<StockFileProblem>(read).kind);
  const Stock& again = std::get<Stock>(read);
  expect_same_material(again, stock);
  EXPECT_EQ(again.grid().first, stock.grid().first);
  EXPECT_EQ(again.grid().spacing, stock.grid().spacing);
  EXPECT_EQ(again.bounds().min(), stock.bounds().min());
  EXPECT_EQ(again.bounds().max(), stock.bounds().max());
  EXPECT_EQ(again.volume(), stock.volume());
  EXPECT_EQ(write_stock(again), bytes);
}

StockFileProblem problem_of(const std::string& bytes, std::size_t memory_limit = 1 << 30) {
  const StockOrProblem read = read_stock(bytes, memory_limit);
  if (std::holds_alternative<Stock>(read)) {
    ADD_FAILURE() << "has been read";
    return {};
  }
  return std::get<StockFileProblem>(read);
}

template <class Value>
std::string with(std::string bytes, std::size_t at, Value value) {
  for (std::size_t i = 0; i < sizeof(value); ++i) bytes[at + i] = reinterpret_cast<const char*>(&value)[i];
  return bytes;
}

/// The bytes of a file with the check sum that fits them.
std::string sealed(const std::string& bytes) {
  return bytes + with(std::string(8, '\0'), 0, text::hash_on(text::kHashStart, bytes));
}

/// Bytes of one tile of 2 x 1 dexels that is not uniform, between the heights 0 and 10.
std::string two_dexels(const std::string& tile) {
  const std::string uniform = write_stock(Stock(box({0, 0, 0}, {2, 1, 10}), 1));
  return sealed(uniform.substr(0, kTilesAt) + tile);
}
std::string f32(float value) { return with(std::string(4, '\0'), 0, value); }
std::string pair(float one, float other) { return std::string("\2\0", 2) + f32(one) + f32(other); }
std::string further(char row, char column, float bottom, float top) {
  return std::string{row, column} + f32(bottom) + f32(top);
}
std::string cut_tile(const std::string& bottoms, const std::string& tops, const std::string& rest = "") {
  return std::string("\1", 1) + bottoms + tops + std::string{static_cast<char>(rest.size() / 10), '\0', '\0', '\0'} +
         rest;
}

TEST(StockFile, IsReadAsItWasWritten) {
  expect_round_trip(cut_plate());
  expect_round_trip(Stock(kPlate, 0.7));
  expect_round_trip(Stock(solids::Cylinder{{{3, 4, -20}, tilted(30)}, 50, 20}, 0.3));
  expect_round_trip(Stock(box({1, 1, 1}, {1, 1, 1}), 1));
}

TEST(StockFile, GoesOnAsTheStockThatWasWritten) {
  Stock stock = cut_plate();
  Stock again = std::get<Stock>(read_stock(write_stock(stock)));
  const SomeSweeps source;
  const std::vector<Sweep> sweeps = source.make(6, 20);
  const auto outcomes = stock.apply(sweeps);
  const auto of_again = again.apply(sweeps);
  for (std::size_t i = 0; i < outcomes.size(); ++i) EXPECT_EQ(of_again[i].volume, outcomes[i].volume) << i;
  expect_same_material(again, stock);
}

TEST(StockFile, IsSmall) {
  EXPECT_EQ(write_stock(Stock(kPlate, 0.7)).size(), kTilesAt + 12 * 9 + kSumSize);
  Stock slot(box({0, 0, -18}, {640, 640, 0}), 0.5);
  const RevolvedBody tool = flat(10);
  apply(slot, line(tool, {30, 30, -5}, {600, 500, -5}));
  EXPECT_LT(write_stock(slot).size(), 40000U);
}

/// Of a cut with a different height in each dexel: 4 bytes for each, and a little for the whole.
TEST(StockFile, TakesFourBytesForEachHeight) {
  Stock stock(box({0, 0, -18}, {128, 128, 0}), 1);
  const RevolvedBody tool = ball(300, 700);
  apply(stock, line(tool, {41.3, 52.6, -17.5}, {41.3, 52.6, -17.5}));
  EXPECT_LT(write_stock(stock).size(), kTilesAt + 4 * 128 * 128 + 300 + kSumSize);
}

TEST(StockFile, HasUniformTilesOfSeveralHeights) {
  const std::string uniform = write_stock(Stock(box({0, 0, 0}, {512, 1, 10}), 1));
  std::string tiles;
  for (const float top : {5.0F, 10.0F, 10.0F, 5.0F}) tiles += std::string("\0", 1) + f32(0) + f32(top);
  const Stock stock = std::get<Stock>(read_stock(sealed(uniform.substr(0, kTilesAt) + tiles)));
  EXPECT_EQ(stock.volume(), 128 * (5 + 10 + 10 + 5));
}

TEST(StockFile, RefusesOtherFiles) {
  EXPECT_EQ(problem_of("").kind, Kind::NotAStock);
  EXPECT_EQ(problem_of("isosto").kind, Kind::NotAStock);
  EXPECT_EQ(problem_of("solid part").kind, Kind::NotAStock);
  const StockFileProblem other = problem_of(with(write_stock(cut_plate()), kVersionAt, std::uint32_t{3}));
  EXPECT_EQ(other.kind, Kind::OtherVersion);
  EXPECT_EQ(other.version, 3U);
  EXPECT_EQ(other.offset, kVersionAt);
  // The first one, without a check sum.
  const std::string bytes = write_stock(cut_plate());
  const std::string old = with(bytes.substr(0, bytes.size() - kSumSize), kVersionAt, std::uint32_t{1});
  EXPECT_EQ(problem_of(old).kind, Kind::OtherVersion);
}

TEST(StockFile, RefusesOneByteThatIsAnother) {
  // Of a height that is possible, too.
  const std::string bytes = write_stock(cut_plate());
  std::size_t damaged = 0;
  for (std::size_t at = 0; at < bytes.size(); at += at < 100 ? 7 : 4999)
    for (const int bit : {0, 7}) {
      std::string other = bytes;
      other[at] = static_cast<char>(other[at] ^ (1 << bit));
      damaged += problem_of(other).kind == Kind::Damaged ? 1 : 0;
    }
  EXPECT_GT(damaged, 10U);
}

TEST(StockFile, RefusesWhatIsCutShortOrGoesOn) {
  const std::string bytes = write_stock(cut_plate());
  for (std::size_t size = 8; size < bytes.size(); size += size < 200 ? 3 : 997) {
    const StockFileProblem problem = problem_of(bytes.substr(0, size));
    ASSERT_EQ(problem.kind, Kind::Truncated) << size;
    ASSERT_LE(problem.offset, size);
  }
  const StockFileProblem problem = problem_of(bytes + '\0');
  EXPECT_EQ(problem.kind, Kind::TooLong);
  EXPECT_EQ(problem.offset, bytes.size());
}

TEST(StockFile, RefusesImpossibleGrids) {
  const std::string bytes = write_stock(Stock(kPlate, 0.7));
  for (const std::uint32_t columns : {0U, 0x20001U, 0xFFFFFFFFU}) {
    const StockFileProblem problem = problem_of(with(bytes, kColumnsAt, columns));
    EXPECT_EQ(problem.kind, Kind::ImpossibleValue) << columns;
    EXPECT_EQ(problem.offset, kColumnsAt);
  }
  // 2^20 tiles that are not there.
  const std::string many =
      with(with(bytes, kColumnsAt, std::uint32_t{0x20000}), kColumnsAt + 4, std::uint32_t{0x20000});
  EXPECT_EQ(problem_of(many).kind, Kind::Truncated);
  for (const double bound : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e7,
                             -1e300, 301.0})  // The last one is above the largest x.
    EXPECT_EQ(problem_of(with(bytes, kBoundsAt, bound)).kind, Kind::ImpossibleValue) << bound;
}

TEST(StockFile, RefusesImpossibleHeights) {
  EXPECT_TRUE(std::holds_alternative<Stock>(read_stock(two_dexels(cut_tile(pair(0, 5), pair(1, 9))))));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::string& tile : {
           std::string("\2", 1) + f32(0) + f32(1) + std::string(20, '\0'),                  // no kind of tile
           std::string("\0", 1) + f32(5) + f32(1),                                          // upside down
           std::string("\0", 1) + f32(0) + f32(11),                                         // above the bounds
           std::string("\0", 1) + f32(0) + f32(nan),                                        //
           cut_tile(pair(0, 5), pair(1, 4)),                                                // upside down
           cut_tile(pair(0, -1), pair(1, 4)),                                               // below the bounds
           cut_tile(pair(0, 5), pair(1, nan)),                                              //
           cut_tile(std::string("\3\0", 2) + f32(0) + f32(0) + f32(0), pair(1, 1)),         // too many heights
           cut_tile(std::string(2, '\0') + pair(0, 0), pair(1, 1)),                         // a packet without heights
           cut_tile(pair(2, 2), pair(4, 4), further(0, 2, 0, 1)),                           // outside the tile
           cut_tile(pair(2, 2), pair(4, 4), further(1, 0, 0, 1)),                           // outside the tile
           cut_tile(pair(2, 2), pair(4, 4), further(0, 0, 1, 3)),                           // overlaps
           cut_tile(pair(2, 2), pair(4, 4), further(0, 0, 1, 1)),                           // empty
           cut_tile(pair(2, 2), pair(4, 4), further(0, 1, 0, 1) + further(0, 0, 0, 1)),     // not in order
           cut_tile(pair(2, 2), pair(4, 4), further(0, 0, 1, 2) + further(0, 0, 0, 0.5F)),  // not from the lowest up
           cut_tile(pair(4, 2), pair(4, 4), further(0, 0, 0, 1)),                           // below nothing
       })
    EXPECT_EQ(problem_of(two_dexels(tile)).kind, Kind::ImpossibleValue) << tile.size();
}

TEST(StockFile, RefusesMoreMemoryThanIsAllowed) {
  const Stock stock = cut_plate();
  const std::string bytes = write_stock(stock);
  EXPECT_EQ(problem_of(bytes, 100000).kind, Kind::TooLarge);
  EXPECT_TRUE(std::holds_alternative<Stock>(read_stock(bytes, stock.memory())));
}

}  // namespace
}  // namespace isocnc::stock::cuts
