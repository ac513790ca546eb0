// Times the toolpath's page with a long program: node bench/toolpath_page.mjs [MOVES]
// The programs are those of build/release/bin, or of ISOCNC_BIN_DIR; the page is built first (node vscode-extension/build.mjs).
import { openPage, recordingOf, tell, wholePath } from '../tests/vscode/page.mjs';

const moves = Number(process.argv[2] ?? 1e6);
const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];

/** A bow over and over, a little further each time; one move changed on request. */
function program(changed) {
  const lines = ['M06 T101001', 'S18000 M03', 'G00 X0 Y0 Z10', 'G01 Z0 F6000'];
  for (let i = 0; i < moves; ++i) {
    const angle = (i % 1000) / 80;
    const radius = 300 + (i === changed ? 5 : 0);
    lines.push(`X${(radius * Math.cos(angle) + i / 2000).toFixed(3)} Y${(radius * Math.sin(angle)).toFixed(3)} Z${(-i / moves).toFixed(3)}`);
  }
  return [...lines, 'G00 Z50', 'M05', 'M02', ''].join('\n');
}

function patchOf(from, to) {
  const [old, now] = [from, to].map((text) => Buffer.from(text, 'base64'));
  const most = Math.min(old.length, now.length);
  let [start, tail] = [0, 0];
  while (start < most && old[start] === now[start]) ++start;
  while (tail < most - start && old[old.length - 1 - tail] === now[now.length - 1 - tail]) ++tail;
  return { start, removed: old.length - start - tail, data: now.subarray(start, now.length - tail).toString('base64') };
}

const [first, edited] = [recordingOf(program(-1)), recordingOf(program(moves >> 1))];
const { browser, page } = await openPage();
try {
  const shown = await tell(page, wholePath('1', first));
  const patches = Object.fromEntries(['steps', 'points', 'turns'].map((name) => [name, patchOf(first[name], edited[name])]));
  const taken = await tell(page, { type: 'path', resultId: '2', previousResultId: '1', facts: edited.facts, language: 'en', patches });
  const times = await page.evaluate(async () => {
    const { path, view, player } = globalThis.isocnc;
    const frame = () => new Promise((done) => requestAnimationFrame(done));
    const timed = async (count, act) => {
      const all = [];
      for (let i = 0; i < count; ++i) {
        const begin = performance.now();
        act(i / count);
        all.push(performance.now() - begin);
        await frame();
      }
      return all;
    };
    const seek = await timed(60, (part) => player.seek(part * path.seconds));
    const pick = await timed(15, (part) => view.pick(100 + 400 * part, 300));
    const frames = [];
    for (let i = 0; i < 30; ++i) {
      const begin = performance.now();
      view.orbit(2, 0);
      await frame();
      await frame();
      frames.push((performance.now() - begin) / 2);
    }
    return { points: path.pointCount, seek, pick, frames };
  });
  const megabytes = (recording) => (0.75 * (recording.steps.length + recording.points.length + recording.turns.length)) / 1e6;
  console.log(`moves ${moves}, points ${times.points}, ${megabytes(edited).toFixed(1)} MB`);
  console.log(`first shown      ${shown.toFixed(0)} ms`);
  console.log(`an edit taken in ${taken.toFixed(0)} ms`);
  console.log(`scrubbing        ${median(times.seek).toFixed(2)} ms of script per step`);
  console.log(`click on a move  ${median(times.pick).toFixed(1)} ms`);
  console.log(`a frame          ${median(times.frames).toFixed(0)} ms (by a renderer in software)`);
} finally {
  await browser.close();
}
