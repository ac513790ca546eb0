/** Bundled as its text. */
declare module '*.iso' {
  const text: string;
  export default text;
}
