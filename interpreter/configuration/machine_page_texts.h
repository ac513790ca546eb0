#pragma once

#include "interpreter/dialect/diagnostic.h"

/// The prose of docs/machine.md and docs/it/macchina.md; their tables are made from the keys.
namespace isocnc::configuration {

/// Text before the first table.
inline constexpr dialect::Text kMachineIntroduction = {
    R"(# The machine

What `isolint`, `isorun`, `isols` and `isodap` may know of your machine: the object `machine` of [`isocnc.json`](configuration.md), which stands beside
the programs or above them ([in italiano](it/macchina.md)). This page is made from the table that also reads the file (`isolint --machine-page`); the
[schema](isocnc.schema.json) that editors complete by is made from it, too.

```jsonc
{
  "machine": {
    "axes": {
      "X": {"min": 0, "max": 3200},
      "Y": {"min": 0, "max": 1600},
      "Z": {"min": -250, "max": 0}
    },
    "tools": [
      {"head": 1, "holder": 1, "tool": 1, "name": "cutter 20", "length": 120.5, "radius": 10}
    ]
  }
}
```

is enough to begin with. All else may be left out: what the machine does not tell is not checked (without `tools` any tool may be mounted, but
an empty list is a machine without any), and times come from the [default machine](motion.md#the-machine). A larger file stands beside its program in [`examples/machine`](../examples/machine/isocnc.json);
[`examples/machines`](../examples/machines/head.json) has ready ones with a [head](../examples/machines/head.json), a
[table](../examples/machines/table.json) and [three axes](../examples/machines/three-axis.json), which `isorun --machine FILE` takes as they are. `isolint --show-config`
prints all that is in force, and every command names a key that is misspelt.

The travel of `axes` is judged twice: `isolint` holds the tool tip against it (W130), which needs no more than the program; `isorun` and
`isolint --verify` hold the joints against it (E160), that is the spindle nose, with the tool's length and what the head swings. Speeds, accelerations, kinematics and times serve
`isorun` and what the editors show of it.

Codes in parentheses are the [findings](rules.md) that a key brings about. Machine coordinates are those of the control without any G92; how B and C
are counted and where their axes stand is in [motion.md](motion.md#kinematics).
)",
    R"(# La macchina

Che cosa `isolint`, `isorun`, `isols` e `isodap` possono sapere della tua macchina: l'oggetto `machine` di [`isocnc.json`](configurazione.md), che sta nella
cartella dei programmi o in una sopra ([in English](../machine.md)). Questa pagina nasce dalla tabella che serve anche a leggere il file (`isolint --lang it --machine-page`); dalla stessa
tabella nasce lo [schema](../isocnc.schema.json) con cui gli editor completano le chiavi.

```jsonc
{
  "machine": {
    "axes": {
      "X": {"min": 0, "max": 3200},
      "Y": {"min": 0, "max": 1600},
      "Z": {"min": -250, "max": 0}
    },
    "tools": [
      {"head": 1, "holder": 1, "tool": 1, "name": "fresa 20", "length": 120.5, "radius": 10}
    ]
  }
}
```

basta per cominciare. Tutto il resto si può lasciare fuori: ciò che la macchina non dice non viene controllato (senza `tools` si può montare qualsiasi utensile, mentre
un elenco vuoto è una macchina che non ne ha), e i tempi sono quelli della [macchina di base](../motion.md#the-machine). Un file più completo sta accanto al suo programma in
[`examples/machine`](../../examples/machine/isocnc.json); in [`examples/machines`](../../examples/machines/head.json) ce ne sono di pronti, con una
[testa](../../examples/machines/head.json), una [tavola](../../examples/machines/table.json) e [tre assi](../../examples/machines/three-axis.json), che `isorun --machine FILE`
prende così come sono. `isolint --show-config` mostra tutto ciò che vale, e ogni comando segnala una chiave scritta male.

La corsa in `axes` viene confrontata due volte: `isolint` la confronta con la punta dell'utensile (W130), e per questo gli basta il programma; `isorun` e
`isolint --verify` con gli assi macchina (E160), cioè col naso del mandrino, tenendo conto della lunghezza dell'utensile e di quanto oscilla la testa. Velocità, accelerazioni, cinematica e tempi servono
a `isorun` e a ciò che ne mostrano gli editor.

I codici fra parentesi sono le [segnalazioni](codici.md) legate a una chiave. Le coordinate macchina sono quelle del controllo senza alcuna G92; come si contano B e C
e dove stanno i loro assi è spiegato in [motion.md](../motion.md#kinematics), in inglese.
)"};

/// Text after the table of machine.kinematics.
inline constexpr dialect::Text kMeasuringAHead = {
    R"(
### Measuring a head

![A head from the side and from above, with B and C at 0: bFromC goes from the C axis to the B axis, spindleFromB from the B axis to the spindle axis, pivot from the B axis down to the spindle nose. With C at 90 the B axis is turned with it.](images/head.svg)

Measure with B and C at 0. `bFromC` goes from the C axis to the B axis, `spindleFromB` from the B axis to the spindle axis, both along the X, Y and Z
of the machine: a B axis that lies 20 mm further in +X than the C axis is `"bFromC": {"x": 20}`, one further in -X has -20. `pivot` goes down from the B axis
to the spindle nose, and is never negative.

The C axis is a vertical line and the B axis one along Y. So of `bFromC.y` and `spindleFromB.y` only the sum counts, `bFromC.z` does not count at all, and
`spindleFromB.z` shortens the pivot: leave these three at 0 where they are not known.

To compare with the control: with `pivot` 100, `bFromC.x` 20, `spindleFromB.y` 7, a tool of 50 mm, its tip at X0 Y0 Z0 and C at 90, the axes X, Y and Z stand at
27, -13 and 50. `isorun` says so in `finalJoints` of its [summary as JSON](isorun.md#the-summary-as-json), and in the `joints` of its samples.
)",
    R"(
### Misurare una testa

![Una testa di lato e dall'alto, con B e C a 0: bFromC va dall'asse C all'asse B, spindleFromB dall'asse B all'asse del mandrino, pivot dall'asse B giù fino al naso del mandrino. Con C a 90 l'asse B è girato insieme a lui.](../images/head.svg)

Si misura con B e C a 0. `bFromC` va dall'asse C all'asse B, `spindleFromB` dall'asse B all'asse del mandrino, tutti e due lungo X, Y e Z
della macchina: un asse B che sta 20 mm più in +X dell'asse C è `"bFromC": {"x": 20}`, uno che sta 20 mm più in -X ha -20. `pivot` va dall'asse B giù fino
al naso del mandrino e non è mai negativo.

L'asse C è una retta verticale e l'asse B una retta lungo Y. Perciò di `bFromC.y` e `spindleFromB.y` conta solo la somma, `bFromC.z` non conta affatto, e
`spindleFromB.z` accorcia il pivot: se non si conoscono, questi tre si lasciano a 0.

Per confrontare col controllo: con `pivot` 100, `bFromC.x` 20, `spindleFromB.y` 7, un utensile di 50 mm, la punta in X0 Y0 Z0 e C a 90, gli assi X, Y e Z stanno a
27, -13 e 50. `isorun` lo dice in `finalJoints` del suo [riassunto in JSON](isorun.md#il-riassunto-in-json), e in `joints` dei suoi campioni.
)"};

}  // namespace isocnc::configuration
