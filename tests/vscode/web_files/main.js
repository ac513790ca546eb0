// A file system in the memory of the page: what vscode.dev has from a repository.
const vscode = require('vscode');

/** Texts by their names, by folders. */
const content = {}; // filled in

const { FileSystemError, FileType } = vscode;

class Files {
  changed = new vscode.EventEmitter();
  onDidChangeFile = this.changed.event;
  files = new Map();
  folders = new Set(['']);

  constructor() {
    for (const [folder, files] of Object.entries(content)) {
      for (const [name, text] of Object.entries(files)) {
        const path = `${folder}/${name}`;
        this.addFolder(path.slice(0, path.lastIndexOf('/')));
        this.files.set(path, { bytes: new TextEncoder().encode(text), mtime: 1 });
      }
    }
  }

  addFolder(path) {
    for (let at = path; at; at = at.slice(0, at.lastIndexOf('/'))) this.folders.add(at);
  }

  stat(uri) {
    const file = this.files.get(uri.path);
    if (file) return { type: FileType.File, ctime: 0, mtime: file.mtime, size: file.bytes.length };
    if (this.folders.has(uri.path.replace(/\/$/, ''))) return { type: FileType.Directory, ctime: 0, mtime: 0, size: 0 };
    throw FileSystemError.FileNotFound(uri);
  }

  readDirectory(uri) {
    const inside = (path) => path.startsWith(`${uri.path}/`) && !path.slice(uri.path.length + 1).includes('/');
    const names = (paths, type) => [...paths].filter(inside).map((path) => [path.slice(uri.path.length + 1), type]);
    return [...names(this.folders, FileType.Directory), ...names(this.files.keys(), FileType.File)];
  }

  readFile(uri) {
    const file = this.files.get(uri.path);
    if (!file) throw FileSystemError.FileNotFound(uri);
    return file.bytes;
  }

  writeFile(uri, bytes) {
    const old = this.files.get(uri.path);
    this.files.set(uri.path, { bytes, mtime: (old?.mtime ?? 0) + 1 });
    this.changed.fire([{ type: old ? vscode.FileChangeType.Changed : vscode.FileChangeType.Created, uri }]);
  }

  createDirectory(uri) {
    this.addFolder(uri.path);
    this.changed.fire([{ type: vscode.FileChangeType.Created, uri }]);
  }

  delete(uri) {
    this.files.delete(uri.path);
    this.changed.fire([{ type: vscode.FileChangeType.Deleted, uri }]);
  }

  rename(from, to) {
    this.writeFile(to, this.readFile(from));
    this.delete(from);
  }

  watch() {
    return new vscode.Disposable(() => {});
  }
}

exports.activate = ({ subscriptions }) => subscriptions.push(vscode.workspace.registerFileSystemProvider('workshop', new Files()));
