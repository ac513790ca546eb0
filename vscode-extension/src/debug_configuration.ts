/** Launch configurations that are filled in where the user has left something out. */
import { isComplete } from './module/names';

export interface LaunchConfiguration {
  type: string;
  request: string;
  name: string;
  program?: string;
  stopOnEntry?: boolean;
  [key: string]: unknown;
}

/** Of an empty configuration, F5 without a launch.json, one that runs this program; null where there is none to run. */
export function completed(configuration: Partial<LaunchConfiguration>, program: string | null, name: string): LaunchConfiguration | null {
  const isEmpty = !configuration.type && !configuration.request && !configuration.name;
  // VS Code has no ${file} where something else than a text has the focus, such as the toolpath.
  const given = configuration.program === '${file}' ? (program ?? configuration.program) : (configuration.program ?? program);
  if (!given) return null;
  return {
    ...configuration,
    type: 'isocnc',
    request: 'launch',
    name: configuration.name ?? name,
    program: given,
    stopOnEntry: configuration.stopOnEntry ?? isEmpty,
  };
}

/** With the names of files in full; `inFolder` gives them from those in the workspace's folder. */
export function absolute(configuration: LaunchConfiguration, inFolder: ((file: string) => string) | undefined): LaunchConfiguration {
  const from = (file: unknown) => (inFolder && typeof file === 'string' && file && !isComplete(file) ? inFolder(file) : file);
  const named = (['program', 'machine'] as const).filter((key) => key in configuration);
  return { ...configuration, ...Object.fromEntries(named.map((key) => [key, from(configuration[key])])) };
}
