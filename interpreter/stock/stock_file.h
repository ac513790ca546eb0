#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "interpreter/stock/stock.h"

namespace isocnc::stock {

/// Why bytes are no usable file of a stock. Files come from elsewhere, so a problem is an ordinary result.
struct StockFileProblem {
  enum class Kind : std::uint8_t {
    NotAStock,        ///< Does not start as such a file does.
    OtherVersion,     ///< Of another version of the format: see `version`.
    Truncated,        ///< Ends before its end.
    TooLong,          ///< Goes on after its end.
    ImpossibleValue,  ///< A value that no stock has.
    Damaged,          ///< Its check sum is that of other bytes; `offset` is where it stands.
    TooLarge,         ///< Takes more memory than the caller allows.
  };

  Kind kind = Kind::NotAStock;
  std::size_t offset = 0;     ///< First byte of what is wrong.
  std::uint32_t version = 0;  ///< The one that the file states.
};

using StockOrProblem = std::variant<Stock, StockFileProblem>;

/// Writes a stock, without the record of which sweep cut it where, with a check sum. A tile without cuts takes 9 bytes,
/// a cut one 6 for each run of equal heights, and 4 for each dexel of other surfaces.
std::string write_stock(const Stock& stock);

/// Reads what write_stock has written, and nothing of which a byte is another one: all intervals are the same to the
/// last bit, but -0 may become 0. No number in the bytes is trusted; takes time proportional to the bytes and to the
/// memory of the stock, which is at most `memory_limit` bytes.
StockOrProblem read_stock(std::string_view bytes, std::size_t memory_limit = std::size_t{1} << 30);

}  // namespace isocnc::stock
