// Makes the page of isorun --plot FILE.html and writes it as C++ source: node build.mjs OUT.cpp
import { writeFileSync } from 'node:fs';
import { makePage } from './page_file.mjs';

const page = await makePage();

/** A string literal; in pieces, since an escape takes all digits behind it. */
function literal(text) {
  const escaped = (byte) => {
    const character = String.fromCharCode(byte);
    if (character === '\n') return '\\n"\n    "';
    if (character === '"' || character === '\\') return `\\${character}`;
    // Octal escapes end after three digits; ?? could begin a trigraph.
    return byte < 0x20 || byte > 0x7e || character === '?' ? `\\${byte.toString(8).padStart(3, '0')}` : character;
  };
  return `"${Array.from(Buffer.from(text, 'utf8'), escaped).join('')}"`;
}

writeFileSync(
  process.argv[2],
  `#include "interpreter/plot/page_template.h"

namespace isocnc::plot {

static constexpr char kPage[] =
    ${literal(page)};

const std::string_view kPageTemplate(kPage, sizeof kPage - 1);

}  // namespace isocnc::plot
`,
);
