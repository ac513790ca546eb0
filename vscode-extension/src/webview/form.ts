/** The page of the form: fields made from the schema, which send each change and show what the text then says. */
import type { FromPage, Path, ToFormPage } from '../form/messages';
import { beginning, fieldOf, mayBe, newTool, numberIn, titleOf, type Schema } from '../form/schema';

declare function acquireVsCodeApi(): { postMessage(message: FromPage): void };
const editor = acquireVsCodeApi();

const set = (path: Path, value?: unknown) => editor.postMessage(value === undefined ? { type: 'set', path } : { type: 'set', path, value });

type Value = Record<string, unknown>;
const isObject = (value: unknown): value is Value => typeof value === 'object' && value !== null && !Array.isArray(value);
const idOf = (path: Path) => path.join('.');

let shown: ToFormPage;
/** Which parts are open, by their paths; they stay so when the text changes. */
const open = new Set<string>(['machine', 'machine.tools']);

function made<Name extends keyof HTMLElementTagNameMap>(name: Name, content: Partial<HTMLElementTagNameMap[Name]> = {}, ...children: Node[]): HTMLElementTagNameMap[Name] {
  const element = Object.assign(document.createElement(name), content);
  element.append(...children);
  return element;
}

function button(text: string, act: () => void, label = text): HTMLButtonElement {
  const element = made('button', { type: 'button', textContent: text });
  element.setAttribute('aria-label', label);
  element.addEventListener('click', act);
  return element;
}

/** What a key means; words between backticks are code. */
function help(text: string): HTMLParagraphElement {
  return made('p', { className: 'help' }, ...text.split('`').map((each, i) => (i % 2 === 1 ? made('code', { textContent: each }) : document.createTextNode(each))));
}

/** A label with its field, and what the key means. */
function row(name: string, schema: Schema, path: Path, field: HTMLElement, isRequired: boolean): HTMLElement {
  field.id = idOf(path);
  const label = made('label', { textContent: isRequired ? `${name} *` : name, htmlFor: field.id });
  const meaning = Object.assign(help(schema.description ?? ''), { id: `${field.id}.help` });
  field.setAttribute('aria-describedby', meaning.id);
  return made('div', { className: 'row' }, label, field, meaning);
}

function numberField(schema: Schema, path: Path, value: unknown): HTMLInputElement {
  const field = made('input', { type: 'text', inputMode: 'decimal', value: typeof value === 'number' ? String(value) : '' });
  field.addEventListener('change', () => {
    const number = numberIn(field.value);
    const isRight = number === null || mayBe(number, schema);
    field.setAttribute('aria-invalid', String(!isRight));
    if (number === null) set(path);
    else if (isRight) set(path, number);
  });
  return field;
}

function textField(schema: Schema, path: Path, value: unknown): HTMLInputElement {
  const field = made('input', { type: 'text', value: typeof value === 'string' ? value : '' });
  field.addEventListener('change', () => {
    const isRight = field.value === '' || !schema.pattern || new RegExp(schema.pattern).test(field.value);
    field.setAttribute('aria-invalid', String(!isRight));
    if (isRight) set(path, field.value === '' ? undefined : field.value);
  });
  return field;
}

function choiceField(choices: [value: unknown, text: string][], path: Path, value: unknown): HTMLSelectElement {
  const field = made('select', {}, made('option', { value: '', textContent: '–' }), ...choices.map(([each, text], i) => made('option', { value: String(i + 1), textContent: text, selected: each === value })));
  field.addEventListener('change', () => set(path, field.value === '' ? undefined : choices[Number(field.value) - 1][0]));
  return field;
}

/** A field with a line for each text. */
function textsField(path: Path, value: unknown): HTMLTextAreaElement {
  const lines = Array.isArray(value) ? value.map(String) : [];
  const field = made('textarea', { value: lines.join('\n'), rows: Math.max(2, lines.length) });
  field.addEventListener('change', () => {
    const texts = field.value.split('\n').map((line) => line.trim()).filter((line) => line !== '');
    set(path, texts.length > 0 ? texts : undefined);
  });
  return field;
}

/** A row of numbers, all of them or none. */
function numbers(columns: Schema[], value: unknown, change: (numbers: number[] | undefined) => void): HTMLElement {
  const given = Array.isArray(value) ? (value as unknown[]) : [];
  const fields = columns.map((column, i) => {
    const field = made('input', { type: 'text', inputMode: 'decimal', value: typeof given[i] === 'number' ? String(given[i]) : '', placeholder: column.description ?? '' });
    field.setAttribute('aria-label', column.description ?? String(i + 1));
    field.addEventListener('change', () => {
      const all = fields.map((each) => numberIn(each.value));
      if (all.every((each) => each === null)) { change(undefined); return; }
      fields.forEach((each, k) => each.setAttribute('aria-invalid', String(all[k] !== null && !mayBe(all[k], columns[k]))));
      const whole = all.filter((each, k): each is number => each !== null && mayBe(each, columns[k]));
      if (whole.length === columns.length) change(whole);
    });
    return field;
  });
  return made('div', { className: 'numbers' }, ...fields);
}

function rowsField(schema: Schema, path: Path, value: unknown): HTMLElement {
  const columns = (schema.items as Schema).items as Schema[];
  const rows = Array.isArray(value) ? (value as unknown[]) : [];
  const without = (place: number) => rows.filter((_, i) => i !== place);
  const isFixed = schema.minItems !== undefined && schema.minItems === schema.maxItems;
  const lines = rows.map((each, i) => {
    const line = numbers(columns, each, (all) => (all ? set([...path, i], all) : set(path, rows.length > 1 ? without(i) : undefined)));
    if (!isFixed) line.append(button('×', () => set(path, rows.length > 1 ? without(i) : undefined), `${shown.texts.remove} ${i + 1}`));
    return line;
  });
  const add = isFixed && rows.length > 0 ? [] : [button(`+ ${shown.texts.add}`, () => set(path, isFixed ? beginning(schema) : [...rows, beginning(schema.items as Schema)]))];
  return made('div', { className: 'rows' }, ...lines, ...add);
}

/** A part that opens and closes. */
function part(title: string, path: Path, description: string, fill: () => Node[], more: Node[] = []): HTMLElement {
  const id = idOf(path);
  const details = made('details', { open: open.has(id), id });
  details.append(made('summary', {}, made('span', { textContent: title }), ...more));
  const body = made('div', { className: 'part' });
  let isFilled = false;
  const show = () => {
    if (isFilled) return;
    isFilled = true;
    if (description) body.append(help(description));
    body.append(...fill());
  };
  details.append(body);
  if (details.open) show();
  details.addEventListener('toggle', () => {
    if (details.open) { open.add(id); show(); } else open.delete(id);
  });
  return details;
}

function objectsField(title: string, schema: Schema, path: Path, value: unknown): HTMLElement {
  const elements = Array.isArray(value) ? (value as unknown[]) : [];
  const item = schema.items as Schema;
  const isTools = path.at(-1) === 'tools';
  const fill = () => [
    ...elements.map((each, i) => {
      const own = [...path, i];
      const remove = button('×', () => set(own), `${shown.texts.remove} ${titleOf(each, i)}`);
      remove.addEventListener('click', (event) => event.preventDefault());
      return part(titleOf(each, i), own, '', () => fieldsOf(item, own, each), [remove]);
    }),
    button(`+ ${shown.texts.add}`, () => {
      open.add(idOf([...path, elements.length]));
      const first = isTools ? newTool(elements) : beginning(item);
      if (Array.isArray(value)) set([...path, elements.length], first);
      else set(path, [first]);
    }, `${shown.texts.add}: ${title}`),
  ];
  return part(`${title} (${elements.length})`, path, schema.description ?? '', fill);
}

function namedField(title: string, schema: Schema, path: Path, value: unknown): HTMLElement {
  const item = schema.additionalProperties as Schema;
  const all = isObject(value) ? value : {};
  const fill = () => {
    const name = made('input', { type: 'text', placeholder: shown.texts.name });
    name.setAttribute('aria-label', `${title}: ${shown.texts.name}`);
    const add = button(`+ ${shown.texts.add}`, () => {
      const key = name.value.trim();
      if (key === '' || key in all) return;
      open.add(idOf([...path, key]));
      set([...path, key], beginning(item));
    }, `${shown.texts.add}: ${title}`);
    return [
      ...Object.entries(all).map(([key, each]) => {
        const own = [...path, key];
        const remove = button('×', () => set(own), `${shown.texts.remove} ${key}`);
        remove.addEventListener('click', (event) => event.preventDefault());
        return part(key, own, '', () => (fieldOf(item) === 'object' ? fieldsOf(item, own, each) : [fieldFor('', item, own, each, false)]), [remove]);
      }),
      made('div', { className: 'numbers' }, name, add),
    ];
  };
  return part(`${title} (${Object.keys(all).length})`, path, schema.description ?? '', fill);
}

function fieldFor(name: string, schema: Schema, path: Path, value: unknown, isRequired: boolean): HTMLElement {
  switch (fieldOf(schema)) {
    case 'object':
      return part(name, path, schema.description ?? '', () => fieldsOf(schema, path, value));
    case 'objects':
      return objectsField(name, schema, path, value);
    case 'named':
      return namedField(name, schema, path, value);
    case 'number':
      return row(name, schema, path, numberField(schema, path, value), isRequired);
    case 'text':
      return row(name, schema, path, textField(schema, path, value), isRequired);
    case 'texts':
      return row(name, schema, path, textsField(path, value), isRequired);
    case 'choice':
      return row(name, schema, path, choiceField(schema.enum!.map((each) => [each, each]), path, value), isRequired);
    case 'boolean':
      return row(name, schema, path, choiceField([[true, shown.texts.yes], [false, shown.texts.no]], path, value), isRequired);
    case 'point':
      return row(name, schema, path, numbers(schema.items as Schema[], value, (all) => set(path, all)), isRequired);
    case 'rows':
      return row(name, schema, path, rowsField(schema, path, value), isRequired);
    case 'other':
      return row(name, schema, path, made('output', { textContent: `${shown.texts.inText}${value === undefined ? '' : `: ${JSON.stringify(value)}`}` }), isRequired);
  }
}

function fieldsOf(schema: Schema, path: Path, value: unknown, without: string[] = []): HTMLElement[] {
  const object = isObject(value) ? value : {};
  return Object.entries(schema.properties ?? {})
    .filter(([key]) => !without.includes(key))
    .map(([key, each]) => fieldFor(key, each, [...path, key], object[key], schema.required?.includes(key) ?? false));
}

/** The focus stays where it was, though the fields are new. */
function show(message: ToFormPage): void {
  shown = message;
  const focused = document.activeElement?.id;
  const { schema, value, problems, texts } = message;
  const list = problems.map((each) => made('li', { textContent: each }));
  document.querySelector('#problems')!.replaceChildren(...(value === null ? [made('p', { textContent: texts.broken })] : []), ...(list.length > 0 ? [made('ul', {}, ...list)] : []));
  const form = document.querySelector('#form')!;
  if (value === null) { form.replaceChildren(); return; }
  const machine = schema.properties?.machine;
  if (!machine) { // The setup of a program.
    open.add('');
    form.replaceChildren(made('h1', { textContent: texts.sections.setup }), ...fieldsOf(schema, [], value));
  } else {
    const all = isObject(value) ? value : {};
    const own = isObject(all.machine) ? all.machine : {};
    form.replaceChildren(
      part(texts.sections.machine, ['machine'], machine.description ?? '', () => fieldsOf(machine, ['machine'], own, ['tools', 'holders'])),
      objectsField(texts.sections.tools, machine.properties!.tools, ['machine', 'tools'], own.tools),
      namedField(texts.sections.holders, machine.properties!.holders, ['machine', 'holders'], own.holders),
      objectsField(texts.sections.setups, schema.properties!.setups, ['setups'], all.setups),
    );
  }
  if (focused) document.getElementById(focused)?.focus();
}

addEventListener('message', ({ data }: MessageEvent<ToFormPage>) => show(data));
editor.postMessage({ type: 'ready' });
