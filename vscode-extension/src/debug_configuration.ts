/** Launch configurations that are filled in where the user has left something out. */

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
  const given = configuration.program ?? program;
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
