#include "interpreter/plot/page_plot.h"

#include "interpreter/plot/page_template.h"
#include "interpreter/text/xml.h"

namespace isocnc::plot {

/// Escapes JSON for use in HTML.
static std::string without_tags(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at))
    json.replace(at, 1, "\\u003c");
  return json;
}

void PagePlot::write(system::OutputFile& output, const Toolpath& path, const PlottedRun& run) {
  const std::string_view page = subject_.page;
  const std::size_t title = page.find(kPageTitle);
  const std::size_t data = page.find(kPageData);
  output.write(page.substr(0, title));
  output.write(text::xml_escaped(subject_.name));
  output.write(page.substr(title + kPageTitle.size(), data - title - kPageTitle.size()));
  const auto block = [&](std::string_view id, std::string_view type, std::string_view content) {
    for (const std::string_view part : {std::string_view("<script id=\"data-"), id, std::string_view("\" type=\""),
                                        type, std::string_view("\">"), content, std::string_view("</script>\n")})
      output.write(part);
  };
  static constexpr std::string_view kBytes = "application/octet-stream;base64";
  block("facts", "application/json", without_tags(recording_.facts(path, run)));
  block("steps", kBytes, base64(recording_.steps()));
  block("points", kBytes, base64(recording_.points()));
  block("turns", kBytes, base64(recording_.turns()));
  if (run.cuts) block("cuts", kBytes, base64(run.cuts->bytes()));
  block("program", kBytes, base64(subject_.program));
  output.write(page.substr(data + kPageData.size()));
}

}  // namespace isocnc::plot
