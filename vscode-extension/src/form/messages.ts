/** What the page of a form and the editor say to each other. */
import type { Schema } from './schema';

/** From the file on: `['machine', 'tools', 0, 'length']`. */
export type Path = (string | number)[];

export type FromPage =
  | { type: 'ready' }
  /** A value; without one the key, or the element, is removed. At the end of a list, the element is added. */
  | { type: 'set'; path: Path; value?: unknown };

export type ToFormPage = {
  type: 'show';
  schema: Schema;
  /** Null where the text is no JSON. */
  value: unknown;
  /** What is wrong with the text, one each. */
  problems: string[];
  texts: FormTexts;
};

/** Words of the page, in the user's language. */
export interface FormTexts {
  add: string;
  remove: string;
  yes: string;
  no: string;
  /** Of a new named part. */
  name: string;
  /** What can only be written in the text. */
  inText: string;
  /** Where the text is no JSON. */
  broken: string;
  sections: Record<'machine' | 'tools' | 'holders' | 'setups' | 'setup', string>;
}
