/** Programs to begin with: those of examples/, and of examples/broken/ with a mistake or more in each. */
import type { Language } from './texts';
import brokenDrilling from '../../../examples/broken/drilling.iso';
import brokenRounding from '../../../examples/broken/edge-rounding.iso';
import brokenFiveAxis from '../../../examples/broken/five-axis.iso';
import brokenOption from '../../../examples/broken/option.iso';
import brokenPocket from '../../../examples/broken/pocket.iso';
import brokenRegisters from '../../../examples/broken/registers.iso';
import contour from '../../../examples/contour-compensation.iso';
import doorPanel from '../../../examples/door-panel.iso';
import drilling from '../../../examples/drilling.iso';
import rounding from '../../../examples/edge-rounding.iso';
import engraving from '../../../examples/engraving.iso';
import fiveAxis from '../../../examples/five-axis.iso';
import fiveFaces from '../../../examples/five-faces.iso';
import helix from '../../../examples/helix-ramp.iso';
import option from '../../../examples/option.iso';
import pocket from '../../../examples/pocket.iso';
import tilted from '../../../examples/tilted-plane.iso';

export interface Example {
  file: string;
  name: Record<Language, string>;
  text: string;
}

export const right: Example[] = [
  { file: 'pocket.iso', name: { en: 'Pocket', it: 'Tasca' }, text: pocket },
  { file: 'drilling.iso', name: { en: 'Drilling', it: 'Foratura' }, text: drilling },
  { file: 'contour-compensation.iso', name: { en: 'Contour with cutter compensation', it: 'Contorno con correzione raggio' }, text: contour },
  { file: 'helix-ramp.iso', name: { en: 'Helix and ramp', it: 'Elica e rampa' }, text: helix },
  { file: 'edge-rounding.iso', name: { en: 'Edge rounding', it: 'Arrotondamento spigoli' }, text: rounding },
  { file: 'engraving.iso', name: { en: 'Engraving', it: 'Incisione' }, text: engraving },
  { file: 'door-panel.iso', name: { en: 'Door panel', it: 'Antina' }, text: doorPanel },
  { file: 'option.iso', name: { en: 'Options with IF and GOTO', it: 'Varianti con IF e GOTO' }, text: option },
  { file: 'five-faces.iso', name: { en: 'Five faces', it: 'Cinque facce' }, text: fiveFaces },
  { file: 'tilted-plane.iso', name: { en: 'Tilted planes', it: 'Piani inclinati' }, text: tilted },
  { file: 'five-axis.iso', name: { en: 'Five axes at once', it: 'Cinque assi insieme' }, text: fiveAxis },
];

export const broken: Example[] = [
  { file: 'edge-rounding.iso', name: { en: 'Edge rounding', it: 'Arrotondamento spigoli' }, text: brokenRounding },
  { file: 'pocket.iso', name: { en: 'Pocket, with the habits of another control', it: 'Tasca, con abitudini di un altro controllo' }, text: brokenPocket },
  { file: 'drilling.iso', name: { en: 'Drilling', it: 'Foratura' }, text: brokenDrilling },
  { file: 'option.iso', name: { en: 'A path without its end', it: 'Un percorso senza fine' }, text: brokenOption },
  { file: 'registers.iso', name: { en: 'Registers', it: 'Registri' }, text: brokenRegisters },
  { file: 'five-axis.iso', name: { en: 'Five axes at once', it: 'Cinque assi insieme' }, text: brokenFiveAxis },
];
