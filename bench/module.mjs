// Times check() of the npm package beside isolint --jobs 1, by processor time: node bench/module.mjs [LINES]
// The programs are those of build/release, the package is that of build/web.
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const build = fileURLToPath(new URL('../build/', import.meta.url));
const { check, load } = await import(join(build, 'web/npm/dist/index.js'));
const lines = process.argv[2] ?? '500000';
const rounds = 5;
const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];

function nativeMilliseconds(program) {
  const script = 'TIMEFORMAT="%U %S"; time "$0" --jobs 1 --no-config --format json "$1" >/dev/null';
  const { stderr } = spawnSync('bash', ['-c', script, join(build, 'release/bin/isolint'), program], { encoding: 'utf8' });
  const [user, system] = stderr.trim().split(/\s+/).map(Number);
  return (user + system) * 1000;
}

async function moduleMilliseconds(text) {
  const begin = process.cpuUsage();
  await check(text);
  const { user, system } = process.cpuUsage(begin);
  return (user + system) / 1000;
}

const folder = mkdtempSync(join(tmpdir(), 'isocnc-bench-'));
try {
  await load();
  console.log(`| ${lines} lines | npm package | isolint | ratio |\n|---|---|---|---|`);
  for (const kind of ['short', 'arcs', 'fiveaxis', 'production', 'errors']) {
    const program = join(folder, `${kind}.iso`);
    writeFileSync(program, execFileSync(join(build, 'release/bench/isocnc_corpus'), [kind, lines, '1'], { maxBuffer: 1 << 30 }));
    const text = readFileSync(program, 'utf8');
    await check(text); // The engine compiles while it runs.
    const pairs = [];
    for (let i = 0; i < rounds; ++i) pairs.push([await moduleMilliseconds(text), nativeMilliseconds(program)]);
    const [module, native] = [0, 1].map((side) => median(pairs.map((pair) => pair[side])));
    const ratio = median(pairs.map(([a, b]) => a / b));
    console.log(`| ${kind} | ${module.toFixed(0)} ms | ${native.toFixed(0)} ms | ${ratio.toFixed(1)} |`);
  }
} finally {
  rmSync(folder, { recursive: true });
}
