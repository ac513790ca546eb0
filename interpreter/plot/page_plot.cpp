#include "interpreter/plot/page_plot.h"

#include <string>

#include "interpreter/plot/page_template.h"
#include "interpreter/text/xml.h"

namespace isocnc::plot {

/// Escapes JSON for use in HTML.
static std::string without_tags(std::string_view json) {
  std::string escaped;
  escaped.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      escaped += "\\u003c";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

PageFile::PageFile(system::OutputFile& output, std::string_view page, std::string_view title) : output_(output) {
  const std::size_t title_at = page.find(kPageTitle);
  const std::size_t data_at = page.find(kPageData);
  output_.write(page.substr(0, title_at));
  output_.write(text::xml_escaped(title));
  output_.write(page.substr(title_at + kPageTitle.size(), data_at - title_at - kPageTitle.size()));
  rest_ = page.substr(data_at + kPageData.size());
}

void PageFile::add(std::string_view id, std::string_view type, std::string_view content) {
  for (const std::string_view part : {std::string_view("<script id=\"data-"), id, std::string_view("\" type=\""), type,
                                      std::string_view("\">"), content, std::string_view("</script>\n")})
    output_.write(part);
}

void PageFile::add_json(std::string_view id, std::string_view json) { add(id, "application/json", without_tags(json)); }

void PageFile::add_bytes(std::string_view id, std::string_view bytes) {
  add(id, "application/octet-stream;base64", base64(bytes));
}

void PageFile::finish() { output_.write(rest_); }

void PagePlot::write(system::OutputFile& output, const Toolpath& path, const PlottedRun& run) {
  PageFile page(output, subject_.page, subject_.name);
  page.add_json("facts", recording_.facts(path, run));
  page.add_bytes("steps", recording_.steps());
  page.add_bytes("points", recording_.points());
  page.add_bytes("turns", recording_.turns());
  if (run.cuts) page.add_bytes("cuts", run.cuts->bytes());
  page.add_bytes("program", subject_.program);
  page.finish();
}

}  // namespace isocnc::plot
