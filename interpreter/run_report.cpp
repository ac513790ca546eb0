#include "interpreter/run_report.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "interpreter/solids/stl.h"
#include "interpreter/stock/stock_file.h"
#include "interpreter/stock/surface.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/process.h"
#include "interpreter/system/system_texts.h"
#include "interpreter/verification/verification_report.h"

namespace isocnc::interpreter {

RunReport::RunReport(const RunOutputs& outputs, const timing::TimedMachine& machine)
    : outputs_(outputs),
      machine_(machine),
      standard_output_(system::kStandardOutput),
      trace_(open(outputs.trace, trace_file_)),
      samples_(open(outputs.samples, samples_file_)),
      summary_(machine),
      // Verifying takes all processors already.
      timing_(machine, outputs.subject.scene ? 1 : system::processor_count(), listeners()),
      findings_(machine),
      compensation_(machine),
      compensated_{.event = [this](const running::Event& event) { timing_.take(event); },
                   .warning =
                       [this](const simulation::RunWarning& warning) {
                         warnings_.push_back(warning);
                         findings_.take(warning);
                       }} {
  open(outputs.plot, plot_file_);
  open(outputs.stock_out, stock_file_);
  const plot::PlotSubject& subject = outputs.subject;
  if (subject.scene) {
    threads::Crew& crew = crew_.emplace(system::processor_count());
    const auto together = [&crew](const std::function<void()>& work) { crew.together(work); };
    verifier_.emplace(*subject.scene, machine, subject.origin,
                      crew.has_helpers() ? verification::WorkTogether(together) : verification::WorkTogether(),
                      outputs.material);
    verification::Alongside alongside;
    if (crew.has_helpers())
      alongside = {.start = [&crew](std::function<void()> task) { crew.start(std::move(task)); },
                   .wait = [&crew] { crew.wait(); }};
    verified_.emplace(*verifier_, std::move(alongside));
  }
  const auto format = plot::plot_format(outputs.plot);
  if (format) plot_.emplace(*format, outputs.subject, machine);
  if (format == plot::PlotFormat::Html && verifier_ && verifier_->material())
    plot::record(*verifier_->material(), cuts_);
  last_sample_.tip = timing_.tip();
  last_sample_.joints = timing_.joints();
}

timing::TimingListeners RunReport::listeners() {
  timing::TimingListeners listeners = {.event = [this](const timing::TimedEvent& timed) { take(timed); }};
  const bool needs_stretches = outputs_.subject.scene || !outputs_.samples.empty() || !outputs_.plot.empty();
  if (needs_stretches)
    listeners.stretch = [this](const motion::Stretch& stretch, const timing::TimedEvent& timed) {
      take(stretch, timed);
    };
  return listeners;
}

system::OutputFile* RunReport::open(const std::string& name, std::optional<system::OutputFile>& file) {
  if (name.empty()) return nullptr;
  if (name == "-") return &standard_output_;
  file.emplace(std::filesystem::path(name));
  if (const int error = file->error())
    problems_.push_back(fmt::format("{}: {}", name, system::cannot_write(error, outputs_.language)));
  return &*file;
}

void RunReport::close(system::OutputFile& output, const std::string& name) {
  if (const std::optional<std::string> problem = system::commit(output, name, outputs_.language))
    problems_.push_back(*problem);
}

void RunReport::take(const timing::TimedEvent& timed) {
  std::optional<kinematics::MadeMove> made;
  if (timed.move) made.emplace(machine_.motion, *timed.move);
  summary_.add(timed, made ? &*made : nullptr);
  if (made) findings_.take(timed.event, *made);
  if (verified_) verified_->take(timed);
  if (plot_) plot_->add(timed);
  if (trace_ != nullptr) trace_->write(to_json(timed, machine_) + '\n');
  if (samples_ == nullptr || !std::holds_alternative<running::ToolEvent>(timed.event.what)) return;
  // The joints stand still; the tip changes with the tool from here on.
  sample_rest(timed.start + timed.duration);
  last_sample_.tip = timing_.tip();
}

void RunReport::take(const motion::Stretch& stretch, const timing::TimedEvent& timed) {
  if (verified_) verified_->take(stretch, timed);
  if (plot_) plot_->add(stretch);
  if (samples_ == nullptr) return;
  sample_rest(stretch.start);
  const double end = stretch.start + stretch.duration;
  for (; static_cast<double>(next_sample_) * outputs_.sample_seconds < end; ++next_sample_)
    write(stretch.at(machine_.motion.kinematics, static_cast<double>(next_sample_) * outputs_.sample_seconds));
  last_sample_ = stretch.at(machine_.motion.kinematics, end);
}

void RunReport::sort_warnings() {
  const auto place = [](const simulation::RunWarning& warning) { return std::pair(warning.line, warning.id); };
  std::stable_sort(
      warnings_.begin(), warnings_.end(),
      [&](const simulation::RunWarning& a, const simulation::RunWarning& b) { return place(a) < place(b); });
  const auto is_same = [&](const simulation::RunWarning& a, const simulation::RunWarning& b) {
    return place(a) == place(b);
  };
  warnings_.erase(std::unique(warnings_.begin(), warnings_.end(), is_same), warnings_.end());
}

/// Writes samples of the machine at rest where the last motion ended.
void RunReport::sample_rest(double until) {
  motion::Sample resting = last_sample_;
  resting.speed = 0;
  for (; static_cast<double>(next_sample_) * outputs_.sample_seconds < until; ++next_sample_) {
    resting.time = static_cast<double>(next_sample_) * outputs_.sample_seconds;
    write(resting);
  }
}

void RunReport::write(const motion::Sample& sample) {
  const kinematics::Coordinates& joints = sample.joints;
  const geometry::Pose& tip = sample.tip;
  samples_->write(fmt::format(
      "{{\"t\":{:.6f},\"tip\":[{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}],\"joints\":[{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}],"
      "\"speed\":{:.6f}}}\n",
      sample.time, tip.tip.x(), tip.tip.y(), tip.tip.z(), tip.b, tip.c, joints[0], joints[1], joints[2], joints[3],
      joints[4], sample.speed));
}

verification::VerifiedRun RunReport::end_run(std::string_view text, const running::RunResult& result) {
  compensation_.finish(compensated_);
  timing_.finish();
  sort_warnings();
  simulation::RunOutcome outcome = findings_.outcome(text, result);
  if (!verifier_) return {.outcome = std::move(outcome)};
  verified_->finish();
  return verification::verified_outcome(std::move(outcome), *verifier_, text, result);
}

std::string RunReport::summary(const verification::VerifiedRun& verified, const std::string& shown_findings) const {
  if (!outputs_.json) {
    const std::string text = shown_findings + summary_.text(outputs_.language);
    return verified.material ? text + in_words(*verified.material, outputs_.language) : text;
  }
  std::string json = summary_.json(outputs_.program_name, outputs_.language);
  if (!verified.certificate && shown_findings.empty()) return json;
  json.resize(json.rfind('}'));
  if (verified.certificate) json += fmt::format(",\"verification\":{}", to_json(verified, outputs_.language).dump());
  if (!shown_findings.empty())
    json += fmt::format(",\"findings\":{}", nlohmann::ordered_json::parse(shown_findings).dump());
  return json + "}\n";
}

/// What remains of the blank, in the format that the name of the file asks for.
std::string RunReport::stock_bytes(const verification::VerifiedRun& verified) const {
  if (!verified.material) return solids::write_stl({});
  const stock::Stock& left = verified.material->stock;
  return outputs_.stock_out.ends_with(".stock") ? stock::write_stock(left) : solids::write_stl(stock::surface_of(left));
}

void RunReport::finish(const running::RunResult& result, const verification::VerifiedRun& verified,
                       const std::string& shown_findings) {
  if (samples_ != nullptr) {
    sample_rest(timing_.time());
    last_sample_.time = timing_.time();
    last_sample_.speed = 0;
    write(last_sample_);
  }
  summary_.finish(result, timing_.time(), timing_.joints(), warnings_);
  if (has_summary()) standard_output_.write(summary(verified, shown_findings));
  if (trace_file_) close(*trace_file_, outputs_.trace);
  if (samples_file_) close(*samples_file_, outputs_.samples);
  if (stock_file_) {
    stock_file_->write(stock_bytes(verified));
    close(*stock_file_, outputs_.stock_out);
  }
  if (plot_) {
    plot_->write(*plot_file_, {result, verified, cuts_ ? &*cuts_ : nullptr});
    close(*plot_file_, outputs_.plot);
  }
  close(standard_output_, "<stdout>");
}

}  // namespace isocnc::interpreter
