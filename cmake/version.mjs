// The version, from the one place that states it, for what is packed by JavaScript.
import { readFileSync } from 'node:fs';

export const [, version] = /project\(isocnc VERSION (\S+)/.exec(readFileSync(new URL('../CMakeLists.txt', import.meta.url), 'utf8'));
