/**
 * Names of files in the module: it sees only `file:` URIs and paths. A file of another scheme, such as
 * `vscode-vfs://github/shop/parts/a.iso`, is `/@vscode-vfs/github/shop/parts/a.iso` there; `-` stands for no authority.
 */

export interface Place {
  scheme: string;
  authority: string;
  path: string;
}

export const pathOf = ({ scheme, authority, path }: Place) => (scheme === 'file' ? path : `/@${scheme}/${authority || '-'}${path}`);

/** The other way around. */
export function placeOf(path: string): Place {
  const [, scheme, authority, rest] = /^\/@([^/]+)\/([^/]+)(\/.*)$/.exec(path) ?? [];
  return scheme ? { scheme, authority: authority === '-' ? '' : authority, path: rest } : { scheme: 'file', authority: '', path };
}

/** URIs have a scheme of two letters or more, unlike C:/part.iso. */
export const isUri = (file: string) => /^[a-z][\w+.-]+:\//i.test(file);

/** Whether a file is named in full: by a path, or as a URI. */
export const isComplete = (file: string) => isUri(file) || /^(?:[a-z]:)?[\\/]/i.test(file);

/** Documents of these schemes are in no file. */
const withoutFile = ['file', 'untitled', 'http', 'https'];

export function toModule(uri: string): string {
  const [, scheme, authority, path] = /^([a-z][a-z0-9+.-]+):(?:\/\/([^/?#]*))?(\/[^?#]*)$/i.exec(uri) ?? [];
  return !scheme || withoutFile.includes(scheme) ? uri : `file://${pathOf({ scheme: encodeURIComponent(scheme), authority, path })}`;
}

export function fromModule(uri: string): string {
  const [, scheme, authority, path] = /^file:\/\/\/(?:@|%40)([^/?#]+)\/([^/?#]+)(\/[^?#]*)$/i.exec(uri) ?? [];
  return scheme ? `${decodeURIComponent(scheme)}:${authority === '-' ? '' : `//${authority}`}${path}` : uri;
}

type Rename = (text: string, key: string) => string;

/** A copy of JSON with other texts and keys. */
function renamed(json: unknown, rename: Rename, key = ''): unknown {
  if (typeof json === 'string') return rename(json, key);
  if (typeof json !== 'object' || json === null) return json;
  // Semantic tokens are many numbers.
  if (Array.isArray(json)) return typeof json[0] === 'number' ? json : json.map((each) => renamed(each, rename, key));
  return Object.fromEntries(Object.entries(json).map(([name, value]) => [rename(name, 'uri'), renamed(value, rename, name)]));
}

const isUriKey = (key: string) => key === 'uri' || key.endsWith('Uri');

/** A message of the language server's protocol with the names that the module has. */
export const messageToModule = (message: unknown) => renamed(message, (text, key) => (isUriKey(key) ? toModule(text) : text));

export const messageFromModule = (message: unknown) => renamed(message, (text) => (text.startsWith('file:///') ? fromModule(text) : text));

/** A message of the debugger's protocol with other paths. */
export const withPaths = (message: unknown, rename: (path: string) => string) =>
  renamed(message, (text, key) => (key === 'path' ? rename(text) : text));
