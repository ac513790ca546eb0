#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "debugger/debuggee/block_record.h"
#include "debugger/debuggee/debuggee.h"
#include "debugger/debuggee/surroundings_limit.h"
#include "interpreter/verification/contact.h"
#include "interpreter/verification/material.h"

namespace isocnc::debuggee {

/// What remains of the blank at any moment of a run, forward and back: always that of a run up to there, to the last
/// bit. It cuts whole blocks, once each on a way forward, and keeps copies, which share what is alike, to go back to. A
/// moment within a block has a copy of its own, which is thrown away. Nothing is cut before somebody asks.
class MaterialHistory {
 public:
  /// Limits of the copies that are kept.
  struct CopyLimits {
    std::size_t bytes = std::size_t{256} << 20;  ///< Of the tiles that they do not share with the copy before.
    double spacing = 4096;                       ///< Least work between two; about that of as many short motions.
    std::size_t nearby = 32;                     ///< Further copies around where was asked last.
  };

  /// Refers to the debuggee and the scene. The workpiece must fit the memory.
  MaterialHistory(const Debuggee& debuggee, const verification::Scene& scene, const removal::Workpiece& workpiece)
      : MaterialHistory(debuggee, scene, workpiece, CopyLimits{}) {}
  MaterialHistory(const Debuggee& debuggee, const verification::Scene& scene, const removal::Workpiece& workpiece,
                  const CopyLimits& limits);
  MaterialHistory(const MaterialHistory&) = delete;
  MaterialHistory& operator=(const MaterialHistory&) = delete;

  // At the moment of a simulation of the run. Between two blocks, "the block" is the one that has ended there, or what
  // has been run by hand after it.
  /// Valid until the next call.
  const stock::Stock& stock_at(const simulation::Simulation& simulation);
  /// What the block has removed so far.
  removal::Removed removed_at(const simulation::Simulation& simulation);
  /// Whether the cutter removes material on the piece of its way, as long as the dexels are apart, that it is on.
  bool is_in_cut(const simulation::Simulation& simulation);
  double blank_volume() const { return begin_->check.blank_volume(); }  ///< mm^3

  /// What is looked for in a block.
  struct BlockQuestions {
    bool contacts = false;
    std::vector<SurroundingsLimit> limits;  ///< Those that are not of the material are passed over.
  };
  /// What happens in a block.
  struct BlockAnswers {
    /// Contacts of error severity that begin, by time, each with the depth that it reaches in this block.
    std::vector<verification::Contact> contacts;
    std::vector<verification::Contact> deeper;  ///< Those that go on from before the block and get deeper in it.
    std::vector<LimitCrossing> crossings;
  };
  /// `record` is that of the whole block.
  BlockAnswers examine(const BlockRecord& record, const BlockQuestions& questions);
  /// The record of a whole block.
  BlockRecord record_of(std::uint64_t block) const;

  /// The run has been changed where this many blocks had been executed.
  void forget_from(std::uint64_t blocks);

  /// Approximate bytes that the copies take beside the blank. For tests, which hold it against the limits.
  std::size_t memory() const;

 private:
  /// The material between two blocks.
  struct BlockState {
    removal::MaterialCheck check;  ///< Nothing of it waits.
    std::uint64_t block = 0;       ///< Blocks executed.
    double work = 0;               ///< Since the start of the run.
    removal::Removed last;         ///< By the block before, or what has been run by hand since.
    /// The last block that has removed material, if the machine has moved on since without a stop for something else.
    std::optional<std::uint64_t> cut_block;
    double free_way = 0;  ///< The way since, mm.
  };
  using StatePointer = std::shared_ptr<const BlockState>;
  struct KeptCopy {
    StatePointer state;
    std::size_t bytes = 0;
  };
  /// The material at a moment, cut in a copy.
  struct CutMoment {
    std::uint64_t block = 0;
    bool is_in_block = false;
    double time = 0;
    StatePointer state;
  };

  class BlockCutting;
  using Copies = std::map<std::uint64_t, KeptCopy>;  ///< By the blocks executed.
  /// A piece of a stretch, and whether the cutter removes material on it.
  struct InCutPiece {
    double time = 0;  ///< Of its begin.
    bool is_in_cut = false;
  };

  StatePointer before(std::uint64_t block);
  StatePointer nearest(std::uint64_t block) const;
  void apply(BlockState& state, const BlockRecord& record) const;
  void feed(removal::MaterialCheck& check, const BlockRecord& record, double until) const;
  removal::MaterialCheck cut_until(const BlockState& from, const BlockRecord& record, double time) const;
  void keep(const StatePointer& state);
  void remember(const StatePointer& state);
  static std::size_t bytes_of(const Copies& copies);
  void thin_out(Copies& copies, std::size_t limit, double& spacing) const;
  const BlockRecord& record(std::uint64_t block);
  const CutMoment& moment_of(const simulation::Simulation& simulation);
  bool ends_in_cut(std::uint64_t block);
  std::vector<InCutPiece> in_cut_pieces(const BlockState& from, const BlockRecord& record, std::size_t piece,
                                        double until) const;
  void find_contacts(const BlockRecord& record, const BlockState& from, const BlockState& to,
                     BlockAnswers& answers) const;
  void find_crossings(const BlockRecord& record, const BlockState& from, const BlockState& to,
                      const BlockQuestions& questions, BlockAnswers& answers);
  std::vector<double> removed_crossings(const SurroundingsLimit& limit, const BlockRecord& record,
                                        const BlockState& from, const BlockState& to) const;
  std::vector<double> in_cut_crossings(const SurroundingsLimit& limit, const BlockRecord& record,
                                       const BlockState& from, const BlockState& to);

  const Debuggee& debuggee_;
  const verification::Scene& scene_;
  const timing::TimedMachine machine_;
  CopyLimits limits_;
  StatePointer begin_;  ///< The blank, before anything has been run by hand.
  Copies copies_;
  double spacing_;  ///< Present least work between two of the copies.
  Copies nearby_;
  std::deque<StatePointer> latest_;  ///< Before the blocks that have been asked for last.
  std::optional<BlockRecord> record_;
  std::optional<CutMoment> moment_;
  std::map<std::uint64_t, bool> ends_in_cut_;  ///< Of blocks that have removed material.
};

}  // namespace isocnc::debuggee
