#include <cstddef>
#include <cstdint>
#include <variant>

#include "interpreter/stock/pieces.h"
#include "interpreter/stock/stock_file.h"
#include "require.h"

namespace isocnc::fuzz {

static void read(std::string_view bytes) {
  using stock::Stock;
  constexpr std::size_t kMemory = 1 << 24;
  const stock::StockOrProblem read = stock::read_stock(bytes, kMemory);
  if (const auto* const problem = std::get_if<stock::StockFileProblem>(&read)) {
    require(problem->offset <= bytes.size(), "a problem lies within the file");
    return;
  }
  const Stock& made = std::get<Stock>(read);
  require(made.volume() >= 0, "there is a volume");
  const std::string written = write_stock(made);
  const stock::StockOrProblem again = stock::read_stock(written);
  require(std::holds_alternative<Stock>(again), "what is written is read");
  require(write_stock(std::get<Stock>(again)) == written, "what is read is written");
  bool is_same = true;
  stock::for_each_change(made, std::get<Stock>(again), [&](int, int) { is_same = false; });
  require(is_same, "the material stays");

  const Stock over(
      stock::LeftStock{.stock = std::make_shared<const Stock>(made), .is_turned_over = true, .quarter_turns = 1},
      made.spacing());
  if (over.grid().columns == made.grid().rows && over.grid().rows == made.grid().columns)
    require(over.volume() <= made.volume() * 1.001 + 0.001, "turned over, it has no more");
  double volume = 0;
  for (const stock::StockPiece& piece : pieces_of(made)) volume += piece.volume;
  require(volume <= made.volume() * 1.001 + 0.001 && made.volume() <= volume * 1.001 + 0.001,
          "the pieces are all of it");
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::read(isocnc::fuzz::as_text(data, size));
  return 0;
}
