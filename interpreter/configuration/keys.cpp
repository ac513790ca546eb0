#include "interpreter/configuration/keys.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <concepts>
#include <utility>

#include <fmt/format.h>

#include "interpreter/configuration/tool_bodies.h"
#include "interpreter/dialect/codes.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/solids/tool_shapes.h"
#include "interpreter/verification/material.h"

namespace isocnc::configuration {

using dialect::Text;

namespace units {
static constexpr Text kMillimeters = {"mm", "mm"};
static constexpr Text kDegrees = {"degrees", "gradi"};
static constexpr Text kSeconds = {"s", "s"};
static constexpr Text kMillimetersPerMinute = {"mm/min", "mm/min"};
static constexpr Text kDegreesPerMinute = {"degrees/min", "gradi/min"};
static constexpr Text kRevolutionsPerMinute = {"rev/min", "giri/min"};
static constexpr Text kAcceleration = {"mm/s^2", "mm/s^2"};
static constexpr Text kRotaryAcceleration = {"degrees/s^2", "gradi/s^2"};
static constexpr Text kJerk = {"mm/s^3", "mm/s^3"};
static constexpr Text kRotaryJerk = {"degrees/s^3", "gradi/s^3"};
}  // namespace units

static constexpr std::string_view kSeverities[] = {"error", "warning", "info", "off"};
static constexpr std::string_view kRuleSeverities[] = {"error", "warning", "info"};
static constexpr std::string_view kModal[] = {"keep", "write", "fold"};
static constexpr std::string_view kToolShapes[] = {"flat", "ball", "bull", "cone", "drill", "disc"};
static constexpr std::string_view kMachineParts[] = {"machine", "X", "Y", "Z", "C", "B"};
static constexpr std::string_view kSetupFrames[] = {"workpiece", "machine"};
static constexpr std::string_view kMachineKinds[] = {"three-axis", "head", "table"};
static constexpr std::string_view kRapidMotions[] = {"interpolated", "independent"};

/// Larger than any machine, and small enough to compute with.
static constexpr NumberRange kLength = {-1e6, 1e6};
static constexpr NumberRange kAngle = {-1e5, 1e5};
/// The minimum is slower than any machine, and fast enough that a program ends.
static constexpr NumberRange kSpeed = {1, 1e7};
static constexpr NumberRange kAcceleration = {1, 1e6};
/// The minimum is a tenth of a micron.
static constexpr NumberRange kRounding = {1e-4, 10};
/// Places and sizes of bodies.
static constexpr NumberRange kPlace = {-solids::kMaxSize, solids::kMaxSize};
static constexpr NumberRange kSize = {0, solids::kMaxSize, true};
/// Of tools and holders.
static constexpr NumberRange kToolSize = {0, 1e4, true};
static constexpr NumberRange kToolDiameter = {0, 1e4};

static constexpr Column kPointColumns[] = {
    {{"x", "x"}, kPlace},
    {{"y", "y"}, kPlace},
    {{"z", "z"}, kPlace},
};
static constexpr std::span kAreaColumns = std::span(kPointColumns).first<2>();
static constexpr Column kProfileColumns[] = {{{"z", "z"}, kToolDiameter}, {{"radius", "raggio"}, kToolDiameter}};
static constexpr Column kStackColumns[] = {
    {{"height", "altezza"}, kToolSize},
    {{"lower diameter", "diametro in basso"}, kToolDiameter},
    {{"upper diameter", "diametro in alto"}, kToolDiameter},
};

std::optional<int> function_number(std::string_view name) {
  if (name.size() < 2 || name.size() > 4 || name.front() != 'M') return std::nullopt;
  int number = 0;
  const auto read = std::from_chars(name.data() + 1, name.data() + name.size(), number);
  if (read.ec != std::errc() || read.ptr != name.data() + name.size()) return std::nullopt;
  return number >= 1 && dialect::is_user_function(number) ? std::optional(number) : std::nullopt;
}

/// The keys of an axis, for its home or its travel.
struct AxisKeys {
  std::string_view letter;
  bool is_rotary;
  std::size_t index;

  Text unit() const { return is_rotary ? units::kDegrees : units::kMillimeters; }
  NumberRange range() const { return is_rotary ? kAngle : kLength; }
};
static constexpr std::array<AxisKeys, 5> kAxes = {
    {{"X", false, 0}, {"Y", false, 1}, {"Z", false, 2}, {"B", true, 3}, {"C", true, 4}}};

static double& home_of(Configuration& configuration, const AxisKeys& axis) {
  geometry::Pose& home = configuration.machine.setup.home;
  if (axis.is_rotary) return axis.letter == "B" ? home.b : home.c;
  return home.tip[static_cast<Eigen::Index>(axis.index)];
}

static std::string lower(std::string_view letter) { return {static_cast<char>(letter.front() - 'A' + 'a')}; }

static void add_home(std::vector<Key>& keys) {
  keys.push_back(
      {.path = "machine.home",
       .documentation = {"Where the spindle nose stands when a program starts, in machine coordinates.",
                         "Dove si trova il naso del mandrino all'avvio del programma, in coordinate macchina."}});
  for (const AxisKeys& axis : kAxes)
    keys.push_back({.path = "machine.home." + lower(axis.letter),
                    .kind = KeyKind::Number,
                    .range = axis.range(),
                    .unit = axis.unit(),
                    .documentation = {"The coordinate at home.", "La quota di home."},
                    .slot = [axis](Configuration& c, ElementIndex) -> ValueSlot { return &home_of(c, axis); }});
}

static std::optional<Objection> min_above_max(const execution::Travel& travel) {
  if (travel.minimum <= travel.maximum) return std::nullopt;
  return Objection{.member = "max", .text = mistakes::kMinAboveMax};
}

static void add_axes(std::vector<Key>& keys) {
  keys.push_back(
      {.path = "machine.axes",
       .documentation = {"From where to where the axes go, in machine coordinates (W130, E160), and how fast.",
                         "Da dove a dove vanno gli assi, in coordinate macchina (W130, E160), e quanto in fretta."}});
  for (const AxisKeys& axis : kAxes) {
    const std::string path = "machine.axes." + std::string(axis.letter);
    const auto travel = [axis](Configuration& c) -> execution::Travel& {
      return c.machine.setup.limits.travel[axis.index];
    };
    keys.push_back({.path = path,
                    .documentation = {"The travel of the axis; open where an end is left out.",
                                      "La corsa dell'asse; senza limite dove manca un estremo."},
                    .objection = [axis](const Configuration& c, ElementIndex) {
                      return min_above_max(c.machine.setup.limits.travel[axis.index]);
                    }});
    keys.push_back({.path = path + ".min",
                    .kind = KeyKind::Number,
                    .range = axis.range(),
                    .unit = axis.unit(),
                    .documentation = {"The minimum coordinate.", "La quota minima."},
                    .slot = [travel](Configuration& c, ElementIndex) -> ValueSlot { return &travel(c).minimum; }});
    keys.push_back({.path = path + ".max",
                    .kind = KeyKind::Number,
                    .range = axis.range(),
                    .unit = axis.unit(),
                    .documentation = {"The maximum coordinate.", "La quota massima."},
                    .slot = [travel](Configuration& c, ElementIndex) -> ValueSlot { return &travel(c).maximum; }});
    keys.push_back(
        {.path = path + ".rapid",
         .kind = KeyKind::Number,
         .range = kSpeed,
         .unit = axis.is_rotary ? units::kDegreesPerMinute : units::kMillimetersPerMinute,
         .documentation = {"The maximum speed of the axis, in rapids and in feed moves.",
                           "La velocità massima dell'asse, in rapido e in lavoro."},
         .slot = [axis](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.rapids[axis.index]; }});
    keys.push_back({.path = path + ".acceleration",
                    .kind = KeyKind::Number,
                    .range = kAcceleration,
                    .unit = axis.is_rotary ? units::kRotaryAcceleration : units::kAcceleration,
                    .documentation = {"The maximum acceleration of the axis, also when it slows down.",
                                      "L'accelerazione massima dell'asse, anche quando frena."},
                    .slot = [axis](Configuration& c, ElementIndex) -> ValueSlot {
                      return &c.machine.timed.motion.axes[axis.index].acceleration;
                    }});
    keys.push_back({.path = path + ".jerk",
                    .kind = KeyKind::Number,
                    .range = {0, 1e7, true},
                    .unit = axis.is_rotary ? units::kRotaryJerk : units::kJerk,
                    .documentation = {"The maximum jerk of the axis; without it, the acceleration may change at once.",
                                      "Il jerk massimo dell'asse; senza, l'accelerazione può cambiare di colpo."},
                    .slot = [axis](Configuration& c, ElementIndex) -> ValueSlot {
                      return &c.machine.timed.motion.axes[axis.index].jerk;
                    }});
  }
}

static void add_limits(std::vector<Key>& keys) {
  keys.push_back({.path = "machine.rapidMotion",
                  .kind = KeyKind::Choice,
                  .choices = kRapidMotions,
                  .documentation =
                      {"How the axes go in a G00: all start and arrive together, on a straight line; or each goes as "
                       "fast as it can and arrives when it can, so that the path bends, and the machine stops before "
                       "and after each G00.",
                       "Come vanno gli assi in una G00: partono e arrivano tutti insieme, su una retta; oppure ognuno "
                       "va più in fretta che può e arriva quando può: il percorso si piega, e la macchina si ferma "
                       "prima e dopo ogni G00."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.rapid_motion; }});
  keys.push_back({.path = "machine.maxFeed",
                  .kind = KeyKind::Number,
                  .range = kSpeed,
                  .unit = units::kMillimetersPerMinute,
                  .documentation = {"The greatest feed rate (W131).", "L'avanzamento massimo (W131)."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.setup.limits.feed; }});
  keys.push_back(
      {.path = "machine.maxRotarySpeed",
       .kind = KeyKind::Number,
       .range = kSpeed,
       .unit = units::kDegreesPerMinute,
       .documentation = {"The maximum speed of B and C (W132).", "La velocità massima di B e C (W132)."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.setup.limits.rotary_speed; }});
  keys.push_back(
      {.path = "machine.maxSpindleSpeed",
       .kind = KeyKind::Number,
       .range = kSpeed,
       .unit = units::kRevolutionsPerMinute,
       .documentation = {"The greatest S (W133).", "La S massima (W133)."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.setup.limits.spindle_speed; }});
  keys.push_back({.path = "machine.tolerances",
                  .documentation = {"How exact the control wants programs to be.",
                                    "La precisione che il controllo pretende dai programmi."}});
  keys.push_back(
      {.path = "machine.tolerances.arc",
       .kind = KeyKind::Number,
       .range = {1e-6, 10},
       .unit = units::kMillimeters,
       .documentation = {"How far the given points of an arc may be from a circle (ISO029, ISO030, ISO031).",
                         "Di quanto i punti dati di un arco possono scostarsi da un cerchio (ISO029, ISO030, ISO031)."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.setup.arc_tolerance; }});
  keys.push_back(
      {.path = "machine.tolerances.chord",
       .kind = KeyKind::Number,
       .range = kRounding,
       .unit = units::kMillimeters,
       .documentation = {"How far the lines that replace an arc in G49 may be from it (I.3.4.3.a).",
                         "Di quanto i tratti che sostituiscono un arco in G49 possono scostarsi da esso (I.3.4.3.a)."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.timed.motion.chord_tolerance; }});
  keys.push_back(
      {.path = "machine.tolerances.corner",
       .kind = KeyKind::Number,
       .range = kRounding,
       .unit = units::kMillimeters,
       .documentation = {"How far from the programmed path the tip may round a corner.",
                         "Di quanto la punta può scostarsi dal percorso programmato per arrotondare uno spigolo."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.timed.motion.corner_tolerance; }});
  keys.push_back(
      {.path = "machine.clearance",
       .kind = KeyKind::Number,
       .range = kLength,
       .unit = units::kMillimeters,
       .documentation = {"The Z of the face frame below which no rapid should go (W134).",
                         "La Z del riferimento di faccia sotto la quale nessun rapido dovrebbe scendere (W134)."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.setup.clearance; }});
}

static geometry::Vec3& head_offset(Configuration& configuration, bool is_spindle) {
  kinematics::Kinematics& kinematics = configuration.machine.timed.motion.kinematics;
  return is_spindle ? kinematics.spindle_from_b : kinematics.b_from_c;
}

static geometry::Vec3& table_point(Configuration& configuration, bool is_of_c) {
  kinematics::Kinematics& kinematics = configuration.machine.timed.motion.kinematics;
  return is_of_c ? kinematics.c_point : kinematics.b_point;
}

static void add_point(std::vector<Key>& keys, const std::string& path, const Text& documentation,
                      geometry::Vec3& (*point)(Configuration&, bool), bool which) {
  keys.push_back({.path = path, .documentation = documentation});
  for (int axis = 0; axis < 3; ++axis)
    keys.push_back(
        {.path = path + "." + std::string(1, static_cast<char>('x' + axis)),
         .kind = KeyKind::Number,
         .range = kLength,
         .unit = units::kMillimeters,
         .documentation = documentation,
         .slot = [point, which, axis](Configuration& c, ElementIndex) -> ValueSlot { return &point(c, which)[axis]; }});
}

static void add_kinematics(std::vector<Key>& keys) {
  keys.push_back(
      {.path = "machine.kinematics",
       .documentation = {"How B and C carry the tool or the workpiece.", "Come B e C portano l'utensile o il pezzo."}});
  keys.push_back(
      {.path = "machine.kinematics.type",
       .kind = KeyKind::Choice,
       .choices = kMachineKinds,
       .documentation =
           {"No rotary axes; a head that C turns and B tilts; a table that B tilts and C turns.",
            "Nessun rotante; una testa girata da C e inclinata da B; una tavola inclinata da B e girata da C."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.kind; }});
  keys.push_back(
      {.path = "machine.kinematics.pivot",
       .kind = KeyKind::Number,
       .range = {0, 1e4},
       .unit = units::kMillimeters,
       .documentation = {"Head: from the B axis down to the spindle nose, with B at 0.",
                         "Testa: dall'asse B giù fino al naso del mandrino, con B a 0."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.timed.motion.kinematics.pivot; }});
  add_point(
      keys, "machine.kinematics.bFromC",
      {"Head: from the C axis to the B axis, with B and C at 0.", "Testa: dall'asse C all'asse B, con B e C a 0."},
      head_offset, false);
  add_point(keys, "machine.kinematics.spindleFromB",
            {"Head: from the B axis to the spindle axis, with B and C at 0.",
             "Testa: dall'asse B all'asse del mandrino, con B e C a 0."},
            head_offset, true);
  add_point(keys, "machine.kinematics.bPoint",
            {"Table: a point of the B axis, in machine coordinates.",
             "Tavola: un punto dell'asse B, in coordinate macchina."},
            table_point, false);
  add_point(keys, "machine.kinematics.cPoint",
            {"Table: a point of the C axis, in machine coordinates, with B at 0.",
             "Tavola: un punto dell'asse C, in coordinate macchina, con B a 0."},
            table_point, true);
}

static void add_times(std::vector<Key>& keys) {
  const auto add = [&](std::string_view name, const Text& documentation, auto member) {
    keys.push_back({.path = "machine.times." + std::string(name),
                    .kind = KeyKind::Number,
                    .range = {0, 1e5},
                    .unit = units::kSeconds,
                    .documentation = documentation,
                    .slot = [member](Configuration& c, ElementIndex) -> ValueSlot {
                      return &(c.machine.timed.durations.*member);
                    }});
  };
  keys.push_back({.path = "machine.times",
                  .documentation = {"How long the machine takes for what is no motion.",
                                    "Quanto tempo prende alla macchina ciò che non è movimento."}});
  add("toolChange",
      {"An M06, from rest to rest; also of the tool that is mounted.",
       "Una M06, da fermo a fermo; anche quella dell'utensile già montato."},
      &timing::Durations::tool_change);
  add("spindle",
      {"An M03, M04 or M05, until the spindle has its speed or stands; one that changes neither takes no time.",
       "Una M03, M04 o M05, finché il mandrino è a regime o fermo; quella che non cambia né verso né giri non prende "
       "tempo."},
      &timing::Durations::spindle);
  add("channel",
      {"A G09 in G48, until the interpolation channel is full again (I.3.8).",
       "Una G09 in G48, finché il canale di interpolazione è di nuovo pieno (I.3.8)."},
      &timing::Durations::channel);
}

static std::optional<Objection> tool_twice(const Configuration& configuration, ElementIndex index) {
  const std::vector<Tool>& tools = *configuration.machine.tools;
  const auto here = tools.begin() + static_cast<std::ptrdiff_t>(index.element);
  if (std::none_of(tools.begin(), here, [&](const Tool& tool) { return tool.code == here->code; })) return std::nullopt;
  return Objection{.member = "", .text = mistakes::kToolTwice};
}

/// Keys of a tool that verification uses.
static void add_tool_bodies(std::vector<Key>& keys) {
  const auto add = [&](std::string_view name, NumberRange range, const Text& unit, const Text& documentation,
                       auto member) {
    keys.push_back({.path = "machine.tools[]." + std::string(name),
                    .kind = KeyKind::Number,
                    .range = range,
                    .unit = unit,
                    .documentation = documentation,
                    .slot = [member](Configuration& c, ElementIndex i) -> ValueSlot {
                      return &((*c.machine.tools)[i.element].*member);
                    }});
  };
  keys.push_back(
      {.path = "machine.tools[].shape",
       .kind = KeyKind::Choice,
       .choices = kToolShapes,
       .documentation = {"What the cutter looks like: a flat end, a ball, a flat end with rounded edge, a cone with a "
                         "sharp tip, a drill, a disc across the spindle axis (W162).",
                         "L'aspetto della fresa: piana, sferica, torica, conica con la punta aguzza, punta da trapano, "
                         "disco perpendicolare al mandrino (W162)."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &(*c.machine.tools)[i.element].shape; }});
  keys.push_back(
      {.path = "machine.tools[].profile",
       .kind = KeyKind::Rows,
       .unit = units::kMillimeters,
       .documentation = {"The outline of a form cutter, instead of `shape`: points from the tip (z = 0) up, joined by "
                         "straight lines.",
                         "Il contorno di una fresa di forma, al posto di `shape`: punti dalla punta (z = 0) in su, "
                         "uniti da segmenti."},
       .columns = kProfileColumns,
       .maximum_rows = solids::kMaxShapePoints - 2,  // Two more for the shank.
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &(*c.machine.tools)[i.element].profile; }});
  add("cornerRadius", {0, 1e4}, units::kMillimeters,
      {"`bull`: the radius of its edge.", "`bull`: il raggio del suo spigolo."}, &Tool::corner_radius);
  add("tipAngle", {0, 179, true}, units::kDegrees,
      {"`cone`, `drill`: the whole angle at the tip.", "`cone`, `drill`: l'angolo intero alla punta."},
      &Tool::tip_angle);
  add("cutLength", kToolSize, units::kMillimeters,
      {"From the tip to the end of what cuts; without it, the cutter goes up to the holder.",
       "Dalla punta alla fine di ciò che taglia; senza, la fresa arriva al portautensile."},
      &Tool::cut_length);
  add("maxDepth", kToolSize, units::kMillimeters,
      {"How deep it may cut at once.", "La profondità massima di una passata."}, &Tool::max_depth);
  add("shank", kToolSize, units::kMillimeters,
      {"The diameter from there to the holder; without it, that of the cutter.",
       "Il diametro da lì al portautensile; senza, quello della fresa."},
      &Tool::shank);
  keys.push_back(
      {.path = "machine.tools[].body",
       .kind = KeyKind::Text,
       .documentation = {"The holder that it is in: a name of `machine.holders`. The top of the holder is at the "
                         "spindle nose.",
                         "Il portautensile in cui sta: un nome di `machine.holders`. La cima del portautensile è al "
                         "naso del mandrino."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &(*c.machine.tools)[i.element].body; }});
}

static void add_tools(std::vector<Key>& keys) {
  const auto add = [&](std::string_view name, NumberRange range, const Text& documentation, auto member) {
    keys.push_back({.path = "machine.tools[]." + std::string(name),
                    .kind = KeyKind::Integer,
                    .range = range,
                    .documentation = documentation,
                    .is_required = true,
                    .slot = [member](Configuration& c, ElementIndex index) -> ValueSlot {
                      return &((*c.machine.tools)[index.element].code.*member);
                    }});
  };
  keys.push_back(
      {.path = "machine.tools",
       .kind = KeyKind::Objects,
       .documentation = {"The tools that the machine has; without this list M06 takes any (ISO067).",
                         "Gli utensili che la macchina ha; senza questo elenco la M06 li accetta tutti (ISO067)."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.tools; },
       .objection = tool_twice,
       .final_objection = [](const Configuration& c, ElementIndex i) -> std::optional<Objection> {
         const auto bodies = tool_bodies(c.machine, (*c.machine.tools)[i.element]);
         const auto* const found = std::get_if<Objection>(&bodies);
         return found ? std::optional(*found) : std::nullopt;
       }});
  add("head", {1, 9}, {"The head: the first digit of the T.", "La testa: la prima cifra della T."},
      &execution::ToolCode::head);
  add("holder", {1, 99}, {"The holder: the second and third digit.", "Il portautensile: la seconda e la terza cifra."},
      &execution::ToolCode::holder);
  add("tool", {1, 999}, {"The tool: the last three digits.", "L'utensile: le ultime tre cifre."},
      &execution::ToolCode::tool);
  keys.push_back(
      {.path = "machine.tools[].name",
       .kind = KeyKind::Text,
       .documentation = {"What the shop calls the tool.", "Come lo chiama l'officina."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &(*c.machine.tools)[i.element].name; }});
  keys.push_back(
      {.path = "machine.tools[].length",
       .kind = KeyKind::Number,
       .range = {0, 1e4, true},
       .unit = units::kMillimeters,
       .documentation = {"From the spindle nose to the tip.", "Dal naso del mandrino alla punta."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &(*c.machine.tools)[i.element].length; }});
  keys.push_back(
      {.path = "machine.tools[].radius",
       .kind = KeyKind::Number,
       .range = {0, 1e4, true},
       .unit = units::kMillimeters,
       .documentation = {"The radius of what cuts, by which G41 and G42 lead the tool beside the contour.",
                         "Il raggio della parte che taglia: di tanto G41 e G42 tengono l'utensile a lato del profilo."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &(*c.machine.tools)[i.element].radius; }});
  add_tool_bodies(keys);
}

static std::optional<Objection> function_twice(const Configuration& configuration, ElementIndex index) {
  const std::vector<NamedFunction>& all = *configuration.machine.functions;
  const auto here = all.begin() + static_cast<std::ptrdiff_t>(index.element);
  if (std::none_of(all.begin(), here, [&](const NamedFunction& each) { return each.number == here->number; }))
    return std::nullopt;
  return Objection{.member = "", .text = mistakes::kFunctionTwice};
}

static void add_functions(std::vector<Key>& keys) {
  keys.push_back({.path = "machine.functions",
                  .kind = KeyKind::Named,
                  .text = TextKind::Function,
                  .documentation = {"The M functions of the shop, each by its M: \"M100\" (W129).",
                                    "Le funzioni M dell'officina, ciascuna con la sua M: \"M100\" (W129)."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.functions; },
                  .objection = function_twice});
  keys.push_back(
      {.path = "machine.functions.*.name",
       .kind = KeyKind::Text,
       .documentation = {"What the function does.", "Che cosa fa la funzione."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &(*c.machine.functions)[i.element].name; }});
  keys.push_back({.path = "machine.functions.*.time",
                  .kind = KeyKind::Number,
                  .range = {0, 1e5},
                  .unit = units::kSeconds,
                  .documentation = {"How long the machine waits for it.", "Per quanto tempo la macchina la attende."},
                  .slot = [](Configuration& c, ElementIndex i) -> ValueSlot {
                    return &(*c.machine.functions)[i.element].seconds;
                  }});
}

static std::optional<Objection> stack_objection(const NumberRows& rows) {
  const auto body = stack_body(rows, 0);
  const auto* const found = std::get_if<Objection>(&body);
  return found ? std::optional(*found) : std::nullopt;
}

static void add_holders(std::vector<Key>& keys) {
  keys.push_back({.path = "machine.holders",
                  .kind = KeyKind::NamedRows,
                  .unit = units::kMillimeters,
                  .documentation = {"Tool holders by name: cylinders and cones one on another, from the collet's face "
                                    "up to the spindle nose.",
                                    "I portautensili col loro nome: cilindri e coni uno sull'altro, dalla faccia della "
                                    "pinza su fino al naso del mandrino."},
                  .columns = kStackColumns,
                  .maximum_rows = solids::kMaxShapePoints,
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.holders; },
                  .objection = [](const Configuration& c,
                                  ElementIndex i) { return stack_objection(c.machine.holders[i.element].rows); }});
  keys.push_back({.path = "machine.nose",
                  .kind = KeyKind::Rows,
                  .unit = units::kMillimeters,
                  .documentation = {"The spindle in the same way, from its nose up. It turns with B and C of a head.",
                                    "Il mandrino allo stesso modo, dal naso in su. Gira con B e C di una testa."},
                  .columns = kStackColumns,
                  .maximum_rows = solids::kMaxShapePoints,
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.nose; },
                  .objection = [](const Configuration& c, ElementIndex) { return stack_objection(*c.machine.nose); }});
}

using GivenShapes = std::vector<std::pair<std::string_view, bool>>;  // By the names of their keys.

static GivenShapes given_in(const DescribedShape& shape) {
  return {{"box", shape.box.has_value()}, {"cylinder", shape.cylinder.has_value()}, {"mesh", shape.mesh.has_value()}};
}

static std::optional<Objection> objection_to(const GivenShapes& shapes, const Text& none) {
  std::string_view first;
  for (const auto& [name, is_given] : shapes) {
    if (is_given && !first.empty())
      return Objection{.member = name, .text = mistakes::kSecondShape, .names = {std::string(first)}};
    if (is_given) first = name;
  }
  if (first.empty()) return Objection{.member = "", .text = none};
  return std::nullopt;
}

static std::optional<Objection> objection_to(const DescribedShape& shape) {
  return objection_to(given_in(shape), mistakes::kOneShape);
}

static std::optional<Objection> objection_to(const DescribedStock& stock) {
  GivenShapes shapes = given_in(stock.shape);
  shapes.emplace_back("from", stock.from.has_value());
  if (auto objection = objection_to(shapes, mistakes::kOneBlank)) return objection;
  if (stock.from) return std::nullopt;
  if (const auto& box = stock.shape.box)
    for (std::size_t i = 0; i < 3; ++i)
      if ((*box)[0][i] == (*box)[1][i]) return Objection{.member = "box", .text = mistakes::kFlatBlank};
  if (stock.is_turned_over) return Objection{.member = "turnedOver", .text = mistakes::kOnlyWithFrom};
  if (stock.quarter_turns) return Objection{.member = "quarterTurns", .text = mistakes::kOnlyWithFrom};
  return std::nullopt;
}

/// Whether the second row, the upper corner, is below the first one.
static std::optional<Objection> objection_to_corners(const NumberRows& corners) {
  for (std::size_t i = 0; i < corners[0].size(); ++i)
    if (corners[1][i] < corners[0][i])
      return Objection{.member = "",
                       .text = mistakes::kCornerBelow,
                       .names = {fmt::format("{}", corners[1][i]), fmt::format("{}", corners[0][i])},
                       .row = 1,
                       .column = i};
  return std::nullopt;
}

using ShapeGetter = DescribedShape& (*)(Configuration& configuration, ElementIndex index);

static const DescribedShape& constant_shape(ShapeGetter shape, const Configuration& configuration, ElementIndex index) {
  return shape(const_cast<Configuration&>(configuration), index);
}

static void add_point_key(std::vector<Key>& keys, std::string path, const Text& unit, const Text& documentation,
                          bool is_required, std::function<ValueSlot(Configuration&, ElementIndex)> slot) {
  keys.push_back({.path = std::move(path),
                  .kind = KeyKind::Point,
                  .unit = unit,
                  .documentation = documentation,
                  .is_required = is_required,
                  .columns = kPointColumns,
                  .slot = std::move(slot)});
}

static void add_file_key(std::vector<Key>& keys, std::string path, const Text& documentation, bool is_required,
                         std::function<ValueSlot(Configuration&, ElementIndex)> slot) {
  keys.push_back({.path = std::move(path),
                  .kind = KeyKind::Text,
                  .text = TextKind::File,
                  .documentation = documentation,
                  .is_required = is_required,
                  .slot = std::move(slot)});
}

static constexpr Text kMeshDocumentation = {"An STL file in mm, in the folder of this file or below.",
                                            "Un file STL in mm, nella cartella di questo file o più sotto."};
static constexpr Text kShiftDocumentation = {"Shifts the shape by this.", "Sposta la forma di tanto."};

static void add_cylinder_keys(std::vector<Key>& keys, const std::string& path, ShapeGetter shape) {
  keys.push_back({.path = path,
                  .documentation = {"A cylinder about any axis.", "Un cilindro intorno a un asse qualsiasi."},
                  .slot = [shape](Configuration& c, ElementIndex i) -> ValueSlot { return &shape(c, i).cylinder; },
                  .objection = [shape](const Configuration& c, ElementIndex i) -> std::optional<Objection> {
                    const auto& axis = constant_shape(shape, c, i).cylinder->axis;
                    if (!axis || axis->norm() > 0) return std::nullopt;
                    return Objection{.member = "axis", .text = mistakes::kNoDirection};
                  }});
  add_point_key(keys, path + ".at", units::kMillimeters, {"The center of its foot.", "Il centro della sua base."}, true,
                [shape](Configuration& c, ElementIndex i) -> ValueSlot { return &shape(c, i).cylinder->at; });
  add_point_key(
      keys, path + ".axis", {},
      {"The direction from the foot on; without it, [0, 0, 1].", "La direzione dalla base in su; senza, [0, 0, 1]."},
      false, [shape](Configuration& c, ElementIndex i) -> ValueSlot { return &shape(c, i).cylinder->axis; });
  const auto add = [&](std::string_view name, const Text& documentation, auto member) {
    keys.push_back({.path = path + "." + std::string(name),
                    .kind = KeyKind::Number,
                    .range = kSize,
                    .unit = units::kMillimeters,
                    .documentation = documentation,
                    .is_required = true,
                    .slot = [shape, member](Configuration& c, ElementIndex i) -> ValueSlot {
                      return &((*shape(c, i).cylinder).*member);
                    }});
  };
  add("height", {"Its length along the axis.", "La sua lunghezza lungo l'asse."}, &DescribedCylinder::height);
  add("diameter", {"Its diameter.", "Il suo diametro."}, &DescribedCylinder::diameter);
}

/// The keys of a shape; `prefix` ends with a point.
static void add_shape_keys(std::vector<Key>& keys, const std::string& prefix, ShapeGetter shape) {
  keys.push_back(
      {.path = prefix + "box",
       .kind = KeyKind::Rows,
       .unit = units::kMillimeters,
       .documentation = {"A box along the axes: its lower and its upper corner.",
                         "Un parallelepipedo lungo gli assi: lo spigolo inferiore e quello superiore."},
       .columns = kPointColumns,
       .maximum_rows = 2,
       .has_all_rows = true,
       .slot = [shape](Configuration& c, ElementIndex i) -> ValueSlot { return &shape(c, i).box; },
       .objection = [shape](const Configuration& c,
                            ElementIndex i) { return objection_to_corners(*constant_shape(shape, c, i).box); }});
  add_cylinder_keys(keys, prefix + "cylinder", shape);
  add_file_key(keys, prefix + "mesh", kMeshDocumentation, false,
               [shape](Configuration& c, ElementIndex i) -> ValueSlot { return &shape(c, i).mesh; });
  add_point_key(keys, prefix + "at", units::kMillimeters, kShiftDocumentation, false,
                [shape](Configuration& c, ElementIndex i) -> ValueSlot { return &shape(c, i).at; });
}

static std::optional<Objection> no_such_part(const Configuration& configuration, ElementIndex index) {
  const std::string& on = configuration.machine.bodies[index.element].on;
  if (configuration.machine.kind != "three-axis" || (on != "B" && on != "C")) return std::nullopt;
  return Objection{.member = "on", .text = mistakes::kNoRotaryAxes, .names = {on}};
}

static void add_machine_bodies(std::vector<Key>& keys) {
  keys.push_back(
      {.path = "machine.bodies",
       .kind = KeyKind::Objects,
       .documentation = {"Parts of the machine that a motion may hit, in machine coordinates with all axes "
                         "at 0: each a box, a cylinder or a mesh (E153).",
                         "Parti della macchina che un movimento può urtare, in coordinate macchina con tutti "
                         "gli assi a 0: ciascuna un box, un cylinder o una mesh (E153)."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.machine.bodies; },
       .objection = [](const Configuration& c,
                       ElementIndex i) { return objection_to(c.machine.bodies[i.element].shape); },
       .final_objection = no_such_part});
  keys.push_back(
      {.path = "machine.bodies[].name",
       .kind = KeyKind::Text,
       .documentation = {"What messages call it.", "Come la chiamano i messaggi."},
       .is_required = true,
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.machine.bodies[i.element].name; }});
  keys.push_back(
      {.path = "machine.bodies[].on",
       .kind = KeyKind::Choice,
       .choices = kMachineParts,
       .documentation =
           {"What carries it; without it, `machine`, which stands. On a head B carries the spindle, and C "
            "what turns but does not tilt; on a table B is the cradle, and C what turns on it.",
            "Che cosa la porta; senza, `machine`, che sta ferma. In una testa B porta il mandrino, e C ciò "
            "che gira senza inclinarsi; in una tavola B è la culla, e C ciò che vi gira sopra."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.machine.bodies[i.element].on; }});
  add_shape_keys(keys, "machine.bodies[].",
                 [](Configuration& c, ElementIndex i) -> DescribedShape& { return c.machine.bodies[i.element].shape; });
}

static void add_spoilboard(std::vector<Key>& keys) {
  const auto add = [&](std::string_view name, NumberRange range, const Text& documentation, bool is_required,
                       auto member) {
    keys.push_back({.path = "setups[].spoilboard." + std::string(name),
                    .kind = KeyKind::Number,
                    .range = range,
                    .unit = units::kMillimeters,
                    .documentation = documentation,
                    .is_required = is_required,
                    .slot = [member](Configuration& c, ElementIndex i) -> ValueSlot {
                      return &((*c.setups[i.element].spoilboard).*member);
                    }});
  };
  keys.push_back(
      {.path = "setups[].spoilboard",
       .documentation = {"The board below the workpiece.", "Il piano martire sotto il pezzo."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].spoilboard; }});
  add("top", kPlace, {"The Z of its upper side.", "La Z della sua faccia superiore."}, true, &DescribedSpoilboard::top);
  add("allow", {0, 1000},
      {"How far cuts may go into it; without it, 0 (E153).", "Di quanto lo si può incidere; senza, 0 (E153)."}, false,
      &DescribedSpoilboard::allow);
  keys.push_back(
      {.path = "setups[].spoilboard.area",
       .kind = KeyKind::Rows,
       .unit = units::kMillimeters,
       .documentation =
           {"Its lower and its upper corner; without it, the board goes on in all directions.",
            "Il suo spigolo inferiore e quello superiore; senza, il piano continua in tutte le direzioni."},
       .columns = kAreaColumns,
       .maximum_rows = 2,
       .has_all_rows = true,
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].spoilboard->area; },
       .objection = [](const Configuration& c,
                       ElementIndex i) { return objection_to_corners(*c.setups[i.element].spoilboard->area); }});
}

static void add_target(std::vector<Key>& keys) {
  keys.push_back({.path = "setups[].target",
                  .documentation = {"The finished part.", "Il pezzo finito."},
                  .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].target; }});
  add_file_key(keys, "setups[].target.mesh", kMeshDocumentation, true,
               [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].target->mesh; });
  add_point_key(keys, "setups[].target.at", units::kMillimeters, kShiftDocumentation, false,
                [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].target->at; });
  keys.push_back(
      {.path = "setups[].target.tolerance",
       .kind = KeyKind::Number,
       .range = {0, 100},
       .unit = units::kMillimeters,
       .documentation = {"How deep a cut may go into it; without it, 0 (E155).",
                         "Di quanto un taglio lo può intaccare; senza, 0 (E155)."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].target->tolerance; }});
}

static void add_fixtures(std::vector<Key>& keys) {
  keys.push_back(
      {.path = "setups[].fixtures",
       .kind = KeyKind::Objects,
       .documentation = {"What holds the workpiece: cups, clamps, stops, each a box, a cylinder or a mesh "
                         "(E152).",
                         "Ciò che tiene il pezzo: ventose, morsetti, battute, ciascuno un box, un cylinder o "
                         "una mesh (E152)."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].fixtures; },
       .objection = [](const Configuration& c,
                       ElementIndex i) { return objection_to(c.setups[i.element].fixtures[i.inner].shape); }});
  keys.push_back({.path = "setups[].fixtures[].name",
                  .kind = KeyKind::Text,
                  .documentation = {"What messages call it.", "Come lo chiamano i messaggi."},
                  .is_required = true,
                  .slot = [](Configuration& c, ElementIndex i) -> ValueSlot {
                    return &c.setups[i.element].fixtures[i.inner].name;
                  }});
  add_shape_keys(keys, "setups[].fixtures[].", [](Configuration& c, ElementIndex i) -> DescribedShape& {
    return c.setups[i.element].fixtures[i.inner].shape;
  });
}

static void add_stock(std::vector<Key>& keys) {
  keys.push_back(
      {.path = "setups[].stock",
       .documentation = {"The blank: a box, a cylinder, a mesh, or what an earlier setup has left.",
                         "Il grezzo: un box, un cylinder, una mesh, o ciò che ha lasciato un attrezzaggio precedente."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].stock; },
       .objection = [](const Configuration& c, ElementIndex i) { return objection_to(*c.setups[i.element].stock); }});
  add_shape_keys(keys, "setups[].stock.",
                 [](Configuration& c, ElementIndex i) -> DescribedShape& { return c.setups[i.element].stock->shape; });
  add_file_key(keys, "setups[].stock.from",
               {"What an earlier setup has left: a file that `isorun --stock-out FILE.stock` has written, in the "
                "folder of this file or below.",
                "Ciò che ha lasciato un attrezzaggio precedente: un file scritto da `isorun --stock-out FILE.stock`, "
                "nella cartella di questo file o più sotto."},
               false, [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].stock->from; });
  keys.push_back(
      {.path = "setups[].stock.turnedOver",
       .kind = KeyKind::Boolean,
       .documentation = {"With `from`: it lies turned over about the X axis, so that Y and Z change their signs.",
                         "Con `from`: è ribaltato intorno all'asse X, così che Y e Z cambiano segno."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot {
         return &c.setups[i.element].stock->is_turned_over;
       }});
  keys.push_back({.path = "setups[].stock.quarterTurns",
                  .kind = KeyKind::Integer,
                  .range = {-3, 3},
                  .documentation =
                      {"With `from`: it is turned about Z by so many quarters of a turn, counterclockwise from above, "
                       "after being turned over and before being shifted.",
                       "Con `from`: è girato intorno a Z di tanti quarti di giro, in senso antiorario visto "
                       "dall'alto, dopo il ribaltamento e prima dello spostamento."},
                  .slot = [](Configuration& c, ElementIndex i) -> ValueSlot {
                    return &c.setups[i.element].stock->quarter_turns;
                  }});
}

static void add_setups(std::vector<Key>& keys) {
  keys.push_back({.path = "setups",
                  .kind = KeyKind::Objects,
                  .documentation = {"What stands around programs; of the entries that name a program, the last one "
                                    "counts.",
                                    "Ciò che sta intorno ai programmi; delle voci che nominano un programma conta "
                                    "l'ultima."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.setups; }});
  keys.push_back({.path = "setups[].paths",
                  .kind = KeyKind::Texts,
                  .text = TextKind::Pattern,
                  .documentation = {"Which programs: patterns of paths from the folder of this file.",
                                    "Quali programmi: modelli di percorso a partire dalla cartella di questo file."},
                  .is_required = true,
                  .is_never_empty = true,
                  .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].paths; }});
  keys.push_back({.path = "setups[].frame",
                  .kind = KeyKind::Choice,
                  .choices = kSetupFrames,
                  .documentation = {"Whose coordinates these are: those of the first G92, or of the machine; without "
                                    "it, `workpiece`.",
                                    "Di chi sono queste coordinate: della prima G92, o della macchina; senza, "
                                    "`workpiece`."},
                  .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].frame; }});
  add_stock(keys);
  add_spoilboard(keys);
  add_fixtures(keys);
  add_target(keys);
  keys.push_back(
      {.path = "setups[].resolution",
       .kind = KeyKind::Number,
       .range = {verification::kFinestResolution, verification::kCoarsestResolution},
       .unit = units::kMillimeters,
       .documentation = {"How fine the stock is simulated.", "Quanto è fine la simulazione del grezzo."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].resolution; }});
  keys.push_back(
      {.path = "setups[].clearance",
       .kind = KeyKind::Number,
       .range = {0, 1000},
       .unit = units::kMillimeters,
       .documentation = {"What comes nearer is reported, even without a contact; without it, 2 (W154).",
                         "Ciò che si avvicina di più viene segnalato, anche senza contatto; senza, 2 (W154)."},
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.setups[i.element].clearance; }});
}

using SelectionGetter = CodeSelection& (*)(Configuration& configuration, ElementIndex index);

static void add_selection_keys(std::vector<Key>& keys, const std::string& path, SelectionGetter selection) {
  keys.push_back(
      {.path = path + ".select",
       .kind = KeyKind::Texts,
       .text = TextKind::Code,
       .documentation = {"Shows these codes alone: codes, names, beginnings of codes, ALL.",
                         "Mostra solo questi codici: codici, nomi, inizi di codici, ALL."},
       .slot = [selection](Configuration& c, ElementIndex i) -> ValueSlot { return &selection(c, i).select; }});
  keys.push_back(
      {.path = path + ".ignore",
       .kind = KeyKind::Texts,
       .text = TextKind::Code,
       .documentation = {"Does not show these codes.", "Non mostra questi codici."},
       .slot = [selection](Configuration& c, ElementIndex i) -> ValueSlot { return &selection(c, i).ignore; }});
  keys.push_back(
      {.path = path + ".severity",
       .kind = KeyKind::Severities,
       .text = TextKind::Code,
       .choices = kSeverities,
       .documentation = {"How much codes weigh.", "Il peso dei codici."},
       .slot = [selection](Configuration& c, ElementIndex i) -> ValueSlot { return &selection(c, i).severity; }});
}

static void add_options(std::vector<Key>& keys) {
  keys.push_back(
      {.path = "lint.options",
       .documentation = {"From where on lint rules speak.", "La soglia oltre la quale le regole segnalano."}});
  const auto add = [&](std::string_view name, NumberRange range, const Text& unit, const Text& documentation,
                       auto member) {
    keys.push_back(
        {.path = "lint.options." + std::string(name),
         .kind = KeyKind::Number,
         .range = range,
         .unit = unit,
         .documentation = documentation,
         .slot = [member](Configuration& c, ElementIndex) -> ValueSlot { return &(c.lint.thresholds.*member); }});
  };
  add("longestDwell", {0, 1e6, true}, units::kSeconds,
      {"The longest G04 that is not reported (W115).", "La G04 più lunga che non viene segnalata (W115)."},
      &dialect::LintThresholds::longest_dwell);
  add("axisAngle", {0, 1}, units::kDegrees,
      {"How far face axes may be from the right angle without a warning (W114).",
       "Di quanto gli assi di faccia possono scostarsi dall'angolo retto senza un avviso (W114)."},
      &dialect::LintThresholds::axis_angle);
  add("vectorError", {0, 0.1}, {},
      {"How far the length of an axis vector may be from 1 without a warning (W128).",
       "Di quanto il modulo di un versore può scostarsi da 1 senza un avviso (W128)."},
      &dialect::LintThresholds::vector_error);
}

/// The keys of a house rule that are given, of those that make its pattern.
static std::vector<std::string_view> patterns_in(const DescribedHouseRule& rule) {
  std::vector<std::string_view> given;
  const auto add = [&](std::string_view name, bool is_given) {
    if (is_given) given.push_back(name);
  };
  add("require", !rule.require.empty());
  add("forbid", !rule.forbid.empty());
  add("comment", !rule.comment.empty());
  add("head", !rule.head.empty());
  add("end", !rule.end.empty());
  add("speedFrom", rule.speed_from.has_value());
  if (!rule.speed_from) add("speedTo", rule.speed_to.has_value());
  add("feedFrom", rule.feed_from.has_value());
  if (!rule.feed_from) add("feedTo", rule.feed_to.has_value());
  add("lowestZ", rule.lowest_z.has_value());
  return given;
}

/// Whether an event of one list stands in another, by any spelling.
static std::optional<Objection> same_event(std::string_view member, const std::vector<std::string>& names,
                                           std::string_view other, const std::vector<std::string>& others) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto is_same = [&](const std::string& name) {
      return dialect::house_event(name) == dialect::house_event(names[i]);
    };
    if (std::any_of(others.begin(), others.end(), is_same))
      return Objection{
          .member = member, .text = mistakes::kSameEvent, .names = {names[i], std::string(other)}, .row = i};
  }
  return std::nullopt;
}

/// Keys that do not belong to the pattern of a house rule, or that it lacks.
static std::optional<Objection> objection_to_parts(const DescribedHouseRule& rule) {
  const bool requires_first = !rule.require.empty() || !rule.comment.empty();
  const bool forbids = !rule.forbid.empty();
  const bool is_by_tool = rule.speed_from || rule.speed_to || rule.feed_from || rule.feed_to || rule.lowest_z;
  struct Part {
    std::string_view member;
    bool is_given;
    bool belongs;
    std::string_view patterns;
  };
  const Part parts[] = {{"before", !rule.before.empty(), requires_first, "require, comment"},
                        {"since", !rule.since.empty(), requires_first, "require, comment"},
                        {"after", !rule.after.empty(), forbids, "forbid"},
                        {"until", !rule.until.empty(), forbids, "forbid"},
                        {"forTools", !rule.tools.empty(), is_by_tool, "speedFrom, speedTo, feedFrom, feedTo, lowestZ"}};
  for (const Part& part : parts)
    if (part.is_given && !part.belongs)
      return Objection{.member = part.member, .text = mistakes::kNotOfPattern, .names = {std::string(part.patterns)}};
  if (requires_first && rule.before.empty())
    return Objection{.member = rule.require.empty() ? "comment" : "require",
                     .text = mistakes::kNeedsKey,
                     .names = {std::string("before")}};
  if (!rule.until.empty() && rule.after.empty())
    return Objection{.member = "until", .text = mistakes::kNeedsKey, .names = {std::string("after")}};
  return std::nullopt;
}

static std::optional<Objection> objection_to_values(const DescribedHouseRule& rule) {
  const auto above = [](std::string_view member, const std::optional<double>& from,
                        const std::optional<double>& to) -> std::optional<Objection> {
    if (!from || !to || *from <= *to) return std::nullopt;
    return Objection{
        .member = member, .text = mistakes::kFromAboveTo, .names = {fmt::format("{}", *from), fmt::format("{}", *to)}};
  };
  if (auto objection = above("speedFrom", rule.speed_from, rule.speed_to)) return objection;
  if (auto objection = above("feedFrom", rule.feed_from, rule.feed_to)) return objection;
  if (auto objection = same_event("require", rule.require, "before", rule.before)) return objection;
  if (auto objection = same_event("until", rule.until, "forbid", rule.forbid)) return objection;
  for (std::size_t i = 0; i < rule.forbid.size() && rule.after.empty(); ++i) {
    using Kind = dialect::HouseEvent::Kind;
    const Kind kind = dialect::house_event(rule.forbid[i])->kind;
    if (kind == Kind::Motion || kind == Kind::Rapid || kind == Kind::Cut)
      return Objection{.member = "forbid", .text = mistakes::kForbidsMotion, .names = {rule.forbid[i]}, .row = i};
  }
  return std::nullopt;
}

static std::optional<Objection> objection_to_house_rule(const Configuration& configuration, ElementIndex index) {
  const std::vector<DescribedHouseRule>& all = configuration.lint.house_rules;
  const DescribedHouseRule& rule = all[index.element];
  const auto here = all.begin() + static_cast<std::ptrdiff_t>(index.element);
  if (std::any_of(all.begin(), here, [&](const DescribedHouseRule& other) { return other.id == rule.id; }))
    return Objection{.member = "id", .text = mistakes::kRuleTwice};
  const std::vector<std::string_view> patterns = patterns_in(rule);
  if (patterns.empty()) return Objection{.member = "", .text = mistakes::kOnePattern};
  if (patterns.size() > 1)
    return Objection{.member = patterns[1], .text = mistakes::kSecondPattern, .names = {std::string(patterns.front())}};
  if (auto objection = objection_to_parts(rule)) return objection;
  if (auto objection = objection_to_values(rule)) return objection;
  std::size_t watches = 0;
  for (const DescribedHouseRule& each : all) watches += std::max<std::size_t>(1, each.head.size() + each.end.size());
  if (watches > dialect::kMaxHouseWatches)
    return Objection{
        .member = "", .text = mistakes::kManyWatches, .names = {fmt::format("{}", dialect::kMaxHouseWatches)}};
  return std::nullopt;
}

template <class Member>
static auto of_house_rule(Member member) {
  return [member](Configuration& c, ElementIndex i) -> ValueSlot { return &(c.lint.house_rules[i.element].*member); };
}

static void add_house_rule_numbers(std::vector<Key>& keys) {
  using Rule = DescribedHouseRule;
  const auto add = [&](std::string_view name, NumberRange range, const Text& unit, const Text& documentation,
                       auto member) {
    keys.push_back({.path = "lint.houseRules[]." + std::string(name),
                    .kind = KeyKind::Number,
                    .range = range,
                    .unit = unit,
                    .documentation = documentation,
                    .slot = of_house_rule(member)});
  };
  add("speedFrom", kSpeed, units::kRevolutionsPerMinute,
      {"Pattern: S is at least this.", "Modello: S è almeno questa."}, &Rule::speed_from);
  add("speedTo", kSpeed, units::kRevolutionsPerMinute,
      {"Pattern, also beside `speedFrom`: S is at most this.",
       "Modello, anche con `speedFrom`: S è al massimo questa."},
      &Rule::speed_to);
  add("feedFrom", kSpeed, units::kMillimetersPerMinute,
      {"Pattern: the feed under G94 is at least this.", "Modello: l'avanzamento con la G94 è almeno questo."},
      &Rule::feed_from);
  add("feedTo", kSpeed, units::kMillimetersPerMinute,
      {"Pattern, also beside `feedFrom`: the feed under G94 is at most this.",
       "Modello, anche con `feedFrom`: l'avanzamento con la G94 è al massimo questo."},
      &Rule::feed_to);
  add("lowestZ", kLength, units::kMillimeters,
      {"Pattern: no motion goes below this Z of the frame in force.",
       "Modello: nessun movimento scende sotto questa Z del riferimento in presa."},
      &Rule::lowest_z);
}

static void add_house_rules(std::vector<Key>& keys) {
  using Rule = DescribedHouseRule;
  keys.push_back({.path = "lint.houseRules",
                  .kind = KeyKind::Objects,
                  .documentation = {"Rules of the shop, each with one pattern (W143).",
                                    "Regole dell'officina, ciascuna con un modello (W143)."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.lint.house_rules; },
                  .objection = objection_to_house_rule});
  const std::string path = "lint.houseRules[].";
  keys.push_back({.path = path + "id",
                  .kind = KeyKind::Text,
                  .text = TextKind::Name,
                  .documentation = {"What messages call the rule.", "Come i messaggi chiamano la regola."},
                  .is_required = true,
                  .slot = of_house_rule(&Rule::id)});
  keys.push_back({.path = path + "message",
                  .kind = KeyKind::Message,
                  .documentation = {"What isolint says where the rule is broken.",
                                    "Che cosa dice isolint quando la regola non è rispettata."},
                  .is_required = true,
                  .slot = of_house_rule(&Rule::message)});
  keys.push_back({.path = path + "severity",
                  .kind = KeyKind::Choice,
                  .choices = kRuleSeverities,
                  .documentation = {"How much it weighs; without it, `warning`.", "Il suo peso; senza, `warning`."},
                  .slot = of_house_rule(&Rule::severity)});
  const auto add_list = [&](std::string_view name, TextKind kind, const Text& documentation, auto member) {
    keys.push_back({.path = path + std::string(name),
                    .kind = KeyKind::Texts,
                    .text = kind,
                    .documentation = documentation,
                    .is_never_empty = true,
                    .slot = of_house_rule(member)});
  };
  add_list(
      "require", TextKind::Event,
      {"Pattern: one of these comes before each of `before`.", "Modello: una di queste viene prima di ogni `before`."},
      &Rule::require);
  keys.push_back({.path = path + "comment",
                  .kind = KeyKind::Text,
                  .documentation = {"Pattern: such a comment comes before each of `before`; a * stands for any text.",
                                    "Modello: un commento così viene prima di ogni `before`; * sta per qualsiasi "
                                    "testo."},
                  .slot = of_house_rule(&Rule::comment)});
  add_list("before", TextKind::Event,
           {"With `require` or `comment`: before what.", "Con `require` o `comment`: prima di che cosa."},
           &Rule::before);
  add_list(
      "since", TextKind::Event,
      {"With `require` or `comment`: asked for anew after each of these, and not before the first; without it, once "
       "in the program.",
       "Con `require` o `comment`: si chiede di nuovo dopo ognuna di queste, e non prima della prima; senza, una "
       "volta nel programma."},
      &Rule::since);
  add_list("forbid", TextKind::Event, {"Pattern: none of these comes.", "Modello: nessuna di queste compare."},
           &Rule::forbid);
  add_list("after", TextKind::Event,
           {"With `forbid`: only after one of these.", "Con `forbid`: solo dopo una di queste."}, &Rule::after);
  add_list("until", TextKind::Event,
           {"With `after`: until one of these.", "Con `after`: finché non viene una di queste."}, &Rule::until);
  add_list("head", TextKind::ModeOrM,
           {"Pattern: each of these is written before the first motion.",
            "Modello: ognuna di queste è scritta prima del primo movimento."},
           &Rule::head);
  add_list("end", TextKind::ModeOrM,
           {"Pattern: each of these is written between the last cut and M02.",
            "Modello: ognuna di queste è scritta fra l'ultimo taglio e la M02."},
           &Rule::end);
  add_house_rule_numbers(keys);
  add_list("forTools", TextKind::Tool,
           {"With S, F or Z: only for these tools, `T101003`, or all that start so, `T101*`.",
            "Con S, F o Z: solo per questi utensili, `T101003`, o per tutti quelli che iniziano così, `T101*`."},
           &Rule::tools);
}

static void add_lint(std::vector<Key>& keys) {
  keys.push_back({.path = "lint",
                  .documentation = {"What isolint reports, and which files are programs.",
                                    "Che cosa segnala isolint, e quali file sono programmi."}});
  add_selection_keys(keys, "lint", [](Configuration& c, ElementIndex) -> CodeSelection& { return c.lint.selection; });
  add_options(keys);
  add_house_rules(keys);
  keys.push_back({.path = "lint.files",
                  .kind = KeyKind::Objects,
                  .documentation = {"What holds for some programs alone; a later entry overrides an earlier one.",
                                    "Ciò che vale solo per alcuni programmi; conta di più quello che viene dopo."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.lint.files; }});
  keys.push_back(
      {.path = "lint.files[].paths",
       .kind = KeyKind::Texts,
       .text = TextKind::Pattern,
       .documentation = {"Which programs: patterns of paths from the folder of this file.",
                         "Quali programmi: modelli di percorso a partire dalla cartella di questo file."},
       .is_required = true,
       .is_never_empty = true,
       .slot = [](Configuration& c, ElementIndex i) -> ValueSlot { return &c.lint.files[i.element].paths; }});
  add_selection_keys(keys, "lint.files[]", [](Configuration& c, ElementIndex i) -> CodeSelection& {
    return c.lint.files[i.element].selection;
  });
  keys.push_back(
      {.path = "lint.extensions",
       .kind = KeyKind::Texts,
       .text = TextKind::Extension,
       .documentation = {"What the names of programs end in; a search of a folder takes these files.",
                         "Come finiscono i nomi dei programmi; una ricerca in una cartella prende questi file."},
       .is_never_empty = true,
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.lint.extensions; }});
  keys.push_back(
      {.path = "lint.exclude",
       .kind = KeyKind::Texts,
       .text = TextKind::Pattern,
       .documentation = {"What a search passes over: patterns of paths from the folder of this file.",
                         "Ciò che una ricerca salta: modelli di percorso a partire dalla cartella di questo file."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.lint.exclude; }});
}

static void add_format(std::vector<Key>& keys) {
  keys.push_back(
      {.path = "format", .documentation = {"How isofmt writes programs.", "Come isofmt scrive i programmi."}});
  keys.push_back({.path = "format.wordOrder",
                  .kind = KeyKind::Boolean,
                  .documentation = {"N first, arguments in the usual order, then F; as --word-order.",
                                    "Prima N, gli argomenti nell'ordine abituale, poi F; come --word-order."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.format.word_order; }});
  keys.push_back({.path = "format.decimals",
                  .kind = KeyKind::Integer,
                  .range = {0, Format::kMaxDecimals},
                  .documentation = {"Drops zeros from numbers that need no more decimals than this; as --decimals.",
                                    "Toglie gli zeri ai numeri ai quali bastano questi decimali; come --decimals."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.format.decimals; }});
  keys.push_back(
      {.path = "format.gDigits",
       .kind = KeyKind::Integer,
       .range = {1, 2},
       .documentation = {"1 writes G1, 2 writes G01; as --g-digits.", "1 scrive G1, 2 scrive G01; come --g-digits."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.format.g_digits; }});
  keys.push_back({.path = "format.modal",
                  .kind = KeyKind::Choice,
                  .choices = kModal,
                  .documentation = {"Motion Gs on each line, where they change, or as written; as --modal.",
                                    "Le G di movimento su ogni linea, dove cambiano, o come scritte; come --modal."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.format.modal; }});
  keys.push_back(
      {.path = "format.renumber",
       .documentation = {"Gives lines new numbers; as --renumber.", "Dà nuovi numeri alle linee; come --renumber."},
       .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.format.renumber; }});
  keys.push_back({.path = "format.renumber.start",
                  .kind = KeyKind::Integer,
                  .range = {0, Renumber::kMaxNumber},
                  .documentation = {"The first number.", "Il primo numero."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.format.renumber->start; }});
  keys.push_back({.path = "format.renumber.step",
                  .kind = KeyKind::Integer,
                  .range = {1, Renumber::kMaxNumber},
                  .documentation = {"From one number to the next.", "Da un numero al successivo."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.format.renumber->step; }});
  keys.push_back({.path = "format.renumber.allLines",
                  .kind = KeyKind::Boolean,
                  .documentation = {"Numbers all lines that hold a block; as --renumber-all.",
                                    "Numera tutte le linee con un blocco; come --renumber-all."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.format.renumber->all_lines; }});
}

static std::vector<Key> make_keys() {
  std::vector<Key> keys;
  keys.push_back({.path = "$schema",
                  .kind = KeyKind::Text,
                  .documentation = {"Where editors find the schema of this file.",
                                    "Dove gli editor trovano lo schema di questo file."}});
  keys.push_back({.path = "language",
                  .kind = KeyKind::Choice,
                  .choices = dialect::kLanguageNames,
                  .documentation = {"The language of messages; as --lang.", "La lingua dei messaggi; come --lang."},
                  .slot = [](Configuration& c, ElementIndex) -> ValueSlot { return &c.language; }});
  keys.push_back({.path = "machine",
                  .documentation = {"The machine that programs are written for.",
                                    "La macchina per cui i programmi sono scritti."}});
  add_home(keys);
  add_axes(keys);
  add_limits(keys);
  add_kinematics(keys);
  add_times(keys);
  add_tools(keys);
  add_holders(keys);
  add_machine_bodies(keys);
  add_functions(keys);
  add_setups(keys);
  add_lint(keys);
  add_format(keys);
  return keys;
}

const std::vector<Key>& all_keys() {
  static const std::vector<Key> kKeys = make_keys();
  return kKeys;
}

std::string prefix_of(const Key* key) {
  if (key == nullptr) return "";
  if (key->kind == KeyKind::Objects) return key->path + "[].";
  return key->path + (key->kind == KeyKind::Named ? ".*." : ".");
}

std::vector<const Key*> keys_below(const Key* key) {
  const std::string prefix = prefix_of(key);
  std::vector<const Key*> below;
  for (const Key& each : all_keys())
    if (each.path.starts_with(prefix) && each.path.find('.', prefix.size()) == std::string::npos)
      below.push_back(&each);
  return below;
}

ElementIndex element_index(const Key& list, ElementIndex owner, std::size_t i) {
  const bool is_in_element = list.path.find("[]") != std::string::npos;
  return is_in_element ? ElementIndex{owner.element, i} : ElementIndex{i, 0};
}

namespace {

template <class T>
concept Element = std::same_as<T, Tool> || std::same_as<T, NamedFunction> || std::same_as<T, FileOverrides> ||
    std::same_as<T, DescribedBody> || std::same_as<T, DescribedSetup> || std::same_as<T, DescribedHouseRule>;

template <class T>
concept AbsentObject = std::same_as<T, Renumber> || std::same_as<T, DescribedCylinder> ||
    std::same_as<T, DescribedStock> || std::same_as<T, DescribedSpoilboard> || std::same_as<T, DescribedTarget>;

template <Element T>
std::vector<T>* elements_in(std::vector<T>* list) {
  return list;
}
template <Element T>
std::vector<T>* elements_in(std::optional<std::vector<T>>* list) {
  return list->has_value() ? &**list : nullptr;
}

template <Element T>
void make_empty(std::vector<T>* list) {
  list->clear();
}
template <Element T>
void make_empty(std::optional<std::vector<T>>* list) {
  list->emplace();
}

template <AbsentObject T>
std::optional<T>& object_in(std::optional<T>* object) {
  return *object;
}

}  // namespace

std::optional<std::size_t> element_count(const ValueSlot& slot) {
  return std::visit(
      [](const auto& list) -> std::optional<std::size_t> {
        if constexpr (requires { elements_in(list); }) {
          if (const auto* const elements = elements_in(list)) return elements->size();
        }
        return std::nullopt;
      },
      slot);
}

void create_list(const ValueSlot& slot) {
  std::visit(
      [](const auto& list) {
        if constexpr (requires { make_empty(list); }) make_empty(list);
      },
      slot);
}

std::size_t add_element(const ValueSlot& slot, const DescriptionPlace& place) {
  return std::visit(
      [&](const auto& list) -> std::size_t {
        if constexpr (requires { elements_in(list); }) {
          auto& elements = *elements_in(list);
          auto& element = elements.emplace_back();
          if constexpr (requires { element.place; }) element.place = place;
          return elements.size() - 1;
        }
        return 0;
      },
      slot);
}

void create_object(const ValueSlot& slot, const DescriptionPlace& place) {
  std::visit(
      [&](const auto& object) {
        if constexpr (requires { object_in(object); }) {
          auto& created = object_in(object).emplace();
          if constexpr (requires { created.place; }) created.place = place;
        }
      },
      slot);
}

bool is_absent(const ValueSlot& slot) {
  return std::visit(
      [](const auto& object) {
        if constexpr (requires { object_in(object); }) return !object_in(object);
        return false;
      },
      slot);
}

}  // namespace isocnc::configuration
