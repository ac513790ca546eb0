// The page of isorun --plot FILE.html, with places for its title (<!--title-->) and its data (<!--data-->).
// The page holds its script and its style, and its policy names their digests: nothing else runs in it or is loaded.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = (name) => fileURLToPath(new URL(name, import.meta.url));

async function bundled(entry) {
  const { outputFiles } = await build({
    entryPoints: [here(entry)],
    bundle: true,
    minify: true,
    write: false,
    charset: 'utf8',
    format: 'iife',
    target: 'es2022',
    legalComments: 'eof',
  });
  // Within HTML nothing may look like the end of the element that it stands in.
  return outputFiles[0].text.replace(/<\/(?=script|style)/gi, '<\\/').replaceAll('<!--', '<\\!--');
}

const digest = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

export async function makePage() {
  const script = await bundled('src/page.ts');
  const style = await bundled('src/page.css');
  const policy = [
    "default-src 'none'",
    `script-src ${digest(script)}`,
    `style-src ${digest(style)}`,
    "base-uri 'none'",
    "form-action 'none'",
    "require-trusted-types-for 'script'",
    "trusted-types 'none'",
  ].join('; ');
  const parts = {
    policy,
    style: `<style>${style}</style>`,
    script: `<script>${script}</script>`,
    program: '<section id="program" tabindex="0" role="listbox" data-label="program"></section>',
    choices: '<button id="language" type="button"></button><button id="theme" type="button"></button>',
  };
  return readFileSync(here('src/page.html'), 'utf8').replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
}
