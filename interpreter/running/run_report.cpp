#include "interpreter/running/run_report.h"

#include <unistd.h>

#include <filesystem>

#include <fmt/format.h>

#include "interpreter/running/system_texts.h"

namespace isocnc::running {

using dialect::Text;

RunReport::RunReport(const RunOutputs& outputs, const TimedMachine& machine)
    : outputs_(outputs),
      machine_(machine),
      standard_output_(STDOUT_FILENO),
      trace_(open(outputs.trace, trace_file_)),
      samples_(open(outputs.samples, samples_file_)),
      summary_(machine),
      timing_(machine, {.event = [this](const TimedEvent& timed) { take(timed); },
                        .move = [this](const motion::Move& move, std::uint64_t line) { summary_.add(move, line); },
                        .stretch = [this](const motion::Stretch& stretch) { take(stretch); }}) {}

OutputFile* RunReport::open(const std::string& name, std::optional<OutputFile>& file) {
  if (name.empty()) return nullptr;
  if (name == "-") return &standard_output_;
  file.emplace(std::filesystem::path(name));
  close(&*file, name);
  return &*file;
}

void RunReport::close(OutputFile* output, const std::string& name) {
  if (output != nullptr && output->flush() != 0)
    problems_.push_back(fmt::format("{}: {}", name, cannot_write(output->error(), outputs_.language)));
}

void RunReport::take(const TimedEvent& timed) {
  summary_.add(timed);
  if (!outputs_.plot.empty()) plot_.add(timed.event);
  if (trace_ != nullptr) trace_->write(to_json(timed) + '\n');
}

void RunReport::take(const motion::Stretch& stretch) {
  if (samples_ == nullptr) return;
  sample_rest(stretch.start);
  const double end = stretch.start + stretch.duration;
  for (; static_cast<double>(next_sample_) * outputs_.sample_seconds < end; ++next_sample_)
    write(stretch.at(machine_.motion.kinematics, static_cast<double>(next_sample_) * outputs_.sample_seconds));
  last_sample_ = stretch.at(machine_.motion.kinematics, end);
}

/// The machine stands where the last motion ended.
void RunReport::sample_rest(double until) {
  motion::Sample resting = last_sample_;
  resting.speed = 0;
  for (; static_cast<double>(next_sample_) * outputs_.sample_seconds < until; ++next_sample_) {
    resting.time = static_cast<double>(next_sample_) * outputs_.sample_seconds;
    write(resting);
  }
}

void RunReport::write(const motion::Sample& sample) {
  const motion::Coordinates& joints = sample.joints;
  const geometry::Pose& tip = sample.tip;
  samples_->write(fmt::format(
      "{{\"t\":{:.6f},\"tip\":[{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}],\"joints\":[{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}],"
      "\"speed\":{:.6f}}}\n",
      sample.time, tip.tip.x(), tip.tip.y(), tip.tip.z(), tip.b, tip.c, joints[0], joints[1], joints[2], joints[3],
      joints[4], sample.speed));
}

void RunReport::finish(const RunResult& result) {
  timing_.finish();
  if (samples_ != nullptr) {
    sample_rest(timing_.time());
    last_sample_.time = timing_.time();
    last_sample_.speed = 0;
    write(last_sample_);
  }
  summary_.finish(result, timing_.time());
  if (!has_standard_output_to_itself())
    standard_output_.write(outputs_.json ? summary_.json(outputs_.program_name, outputs_.language)
                                         : summary_.text(outputs_.language));
  if (trace_file_) close(trace_, outputs_.trace);
  if (samples_file_) close(samples_, outputs_.samples);
  if (!outputs_.plot.empty()) {
    OutputFile plot{std::filesystem::path(outputs_.plot)};
    plot.write(plot_.svg(outputs_.program_name, outputs_.language));
    close(&plot, outputs_.plot);
  }
  close(&standard_output_, "<stdout>");
}

}  // namespace isocnc::running
