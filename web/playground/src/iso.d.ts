/** Bundled as its text. */
declare module '*.iso' {
  const text: string;
  export default text;
}

/** What build.mjs makes: the module, compressed with xz, and the scripts of workers. */
declare module 'embedded:module' {
  const bytes: Uint8Array<ArrayBuffer>;
  export default bytes;
}
declare module 'embedded:unpacker' {
  const script: string;
  export default script;
}
declare module 'embedded:worker' {
  const script: string;
  export default script;
}
