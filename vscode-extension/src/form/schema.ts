/** The schema of isocnc.json as far as a form needs it, and what a form says of a value. */

export interface Schema {
  description?: string;
  type?: 'object' | 'array' | 'string' | 'number' | 'integer' | 'boolean';
  properties?: Record<string, Schema>;
  required?: string[];
  additionalProperties?: boolean | Schema;
  items?: Schema | Schema[];
  minItems?: number;
  maxItems?: number;
  enum?: string[];
  minimum?: number;
  maximum?: number;
  exclusiveMinimum?: number;
  pattern?: string;
}

/** How a value is asked for. */
export type Field = 'object' | 'named' | 'objects' | 'point' | 'rows' | 'texts' | 'text' | 'number' | 'boolean' | 'choice' | 'other';

export function fieldOf(schema: Schema): Field {
  if (schema.enum) return 'choice';
  switch (schema.type) {
    case 'object':
      if (schema.properties) return 'object';
      return typeof schema.additionalProperties === 'object' ? 'named' : 'other';
    case 'array': {
      if (Array.isArray(schema.items)) return 'point';
      if (schema.items?.type === 'object') return 'objects';
      if (schema.items?.type === 'array') return 'rows';
      return schema.items?.type === 'string' ? 'texts' : 'other';
    }
    case 'string':
      return 'text';
    case 'number':
    case 'integer':
      return 'number';
    case 'boolean':
      return 'boolean';
    default:
      return 'other';
  }
}

/** What a new element of a list, or a new named part, begins with: the keys that it needs. */
export function beginning(schema: Schema): unknown {
  switch (fieldOf(schema)) {
    case 'object':
      return Object.fromEntries((schema.required ?? []).map((key) => [key, beginning(schema.properties![key])]));
    case 'number':
      return Math.max(schema.minimum ?? 0, schema.exclusiveMinimum === undefined ? -Infinity : schema.exclusiveMinimum + 1);
    case 'point':
      return (schema.items as Schema[]).map(beginning);
    case 'rows':
      return Array.from({ length: Math.max(1, schema.minItems ?? 1) }, () => beginning(schema.items as Schema));
    case 'objects':
    case 'texts':
      return [];
    case 'choice':
      return schema.enum![0];
    case 'boolean':
      return false;
    default:
      return '';
  }
}

const isObject = (value: unknown): value is Record<string, unknown> => typeof value === 'object' && value !== null && !Array.isArray(value);

/** The next free place in the first holder of the first head, so that a new tool is one of its own. */
export function newTool(tools: readonly unknown[]): Record<string, number> {
  const taken = tools.filter(isObject).filter(({ head, holder }) => head === 1 && holder === 1);
  const last = Math.max(0, ...taken.map(({ tool }) => (typeof tool === 'number' ? tool : 0)));
  return { head: 1, holder: 1, tool: last + 1 };
}

/** `T101003 · ball 6`, or the name of a part, or its number. */
export function titleOf(value: unknown, place: number): string {
  if (!isObject(value)) return String(place + 1);
  const { head, holder, tool, name, paths } = value;
  const digits = (number: unknown, count: number) => (typeof number === 'number' ? String(number).padStart(count, '0') : '?'.repeat(count));
  const parts: string[] = [];
  if (head !== undefined && holder !== undefined) parts.push(`T${digits(head, 1)}${digits(holder, 2)}${digits(tool, 3)}`);
  if (typeof name === 'string' && name !== '') parts.push(name);
  if (Array.isArray(paths) && paths.length > 0) parts.push(paths.join(', '));
  return parts.join(' · ') || String(place + 1);
}

/** The number that is written, with a decimal point or comma; null for none, NaN for something else. */
export function numberIn(text: string): number | null {
  const trimmed = text.trim().replace(',', '.');
  return trimmed === '' ? null : Number(trimmed);
}

/** Whether a number may stand there. */
export function mayBe(number: number, schema: Schema): boolean {
  return (
    Number.isFinite(number) &&
    (schema.type !== 'integer' || Number.isInteger(number)) &&
    number >= (schema.minimum ?? -Infinity) &&
    number <= (schema.maximum ?? Infinity) &&
    number > (schema.exclusiveMinimum ?? -Infinity)
  );
}
