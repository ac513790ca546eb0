#pragma once

#include "bench/corpora/random.h"
#include "bench/corpora/writer.h"

/// The kinds of program that the benchmarks check. Each function writes one of about `lines` lines. All but `errors`
/// are clean: not a warning by the specification, and no slip that a lint rule might frown at (a motion that goes
/// nowhere, a line that cannot be reached, a mode written twice).
namespace isocnc::bench {

void write_short_moves(Writer& out, Random& random, int lines);
void write_arcs(Writer& out, Random& random, int lines);
void write_five_axis(Writer& out, Random& random, int lines);
void write_incremental(Writer& out, Random& random, int lines);

/// What a good post-processor writes. `_if`: with up to 200 options, each an IF on VGPL that skips one operation.
/// `hostile_if`: an IF before every operation, on VGPL and on registers in turn, and registers set everywhere.
void write_production(Writer& out, Random& random, int lines);
void write_production_if(Writer& out, Random& random, int lines);
void write_hostile_if(Writer& out, Random& random, int lines);

/// Moves of 1 mm over a panel from the origin to X1000 Y1000, in the material at Z0 and below; `narrow` over one to
/// X250 Y250; `five_axis` while B and C turn by up to half a degree each.
void write_walk(Writer& out, Random& random, int lines);
void write_narrow_walk(Writer& out, Random& random, int lines);
void write_five_axis_walk(Writer& out, Random& random, int lines);

/// Rows of ramps that cut a table from the origin to X3000 Y1500 all over, by a tool of 20 mm.
void write_table(Writer& out, Random& random, int lines);

/// Exactly one finding on every line but the first five and the last three.
void write_errors(Writer& out, Random& random, int lines);

}  // namespace isocnc::bench
