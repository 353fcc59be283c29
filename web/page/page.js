"use strict";
const $ = (id) => document.getElementById(id);
const bytesOf = (id) => Uint8Array.from(atob($(id).textContent.trim()), (letter) => letter.charCodeAt(0));

// ---- the worker -----------------------------------------------------------------------------------------------------
const worker = new Worker(URL.createObjectURL(new Blob([$("worker").textContent], { type: "text/javascript" })));
const waiting = new Map();
let number = 0;
worker.onmessage = ({ data: { id, answer, error, progress, isBug, about: restarted } }) => {
  const own = waiting.get(id);
  if (!own) return;
  if (progress) return own.progress?.(progress);
  waiting.delete(id);
  if (error === undefined) own.resolve(answer);
  else own.reject(Object.assign(new Error(error), { isBug }));
  if (restarted) begunAgain(restarted);
};
const send = (message, progress) => new Promise((resolve, reject) => {
  waiting.set(++number, { resolve, reject, progress });
  worker.postMessage({ id: number, ...message });
});
const ask = (question, file) => send({ kind: "ask", question, file });
// asks the last of what is wanted while an answer is awaited: what a slider passed is not computed
const latest = (work) => {
  let running = false;
  let again = false;
  return async function run() {
    if (running) { again = true; return; }
    running = true;
    try { do { again = false; await work(); } while (again); } finally { running = false; }
  };
};

// ---- numbers as people read them ------------------------------------------------------------------------------------
const digits = (value, most = 2) => {
  if (value === null || value === undefined) return "∞";
  if (value === 0) return "0";
  const whole = Number(value.toPrecision(Math.abs(value) >= 100 ? 3 : most));
  return Math.abs(whole) < 1e-4 || Math.abs(whole) >= 1e6 ? whole.toExponential() : String(whole);
};
// with their zeros: 0.20
const length = (value, most = 2) => {
  const text = value.toPrecision(Math.abs(value) >= 100 ? 3 : most);
  return value === 0 || /e/.test(text) ? digits(value) : text;
};
const metres = (value, most) => (value === null || value === undefined ? "no limit" : `${length(value, most)} m`);
const band = (limits) => limits && limits[1] !== null
  ? ` (90 % band ${length(limits[0])} to ${length(limits[1])} m)`
  : limits && limits[0] !== null ? ` (90 % band from ${length(limits[0])} m, no upper limit)` : "";
const raised = (power) => [...power].map((own) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(own)]).join("");
const rate = (value) => (value === 0 ? "0" : value.toExponential(1).replace(/e[+]?(.*)/, (_, power) => `·10${raised(power)}`));
const element = (tag, attributes = {}, ...children) => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
};
const escaped = (text) => String(text).replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`);

// ---- state, and the link that holds it ------------------------------------------------------------------------------
const KINDS = {
  pier: { kind: "frame", columns: 1, width_m: 1.2, height_m: 12, column_mass_kg: 43200, deck_mass_kg: 220000,
    tendon_stiffness_n_m: 0, uplift_displacement_m: 0.006, restitution: 0.98 },
  wall: { kind: "block", width_m: 1.2, height_m: 6, mass_kg: 9000, uplift_displacement_m: 0.0005 },
  frame: { kind: "frame", columns: 4, width_m: 1.6, height_m: 9.6, column_mass_kg: 48000, deck_mass_kg: 900000,
    tendon_stiffness_n_m: 1500000, uplift_displacement_m: 0.0005 },
};
const FIELDS = {
  columns: "Columns", column_mass_kg: "Mass of a column, kg", deck_mass_kg: "Mass of the deck, kg", mass_kg: "Mass, kg",
  tendon_stiffness_n_m: "Stiffness of the tendon in each column, N/m; 0: none",
  uplift_displacement_m: "Displacement of the top at which the base lifts off, m",
  restitution: "Restitution",
};
// without a strength of their own, spectrum and fragility are read at that of the structure; without a level, the motion
// is scaled to that of the site
const state = { site: null, measure: null, period: 2475, strength: null, kind: "pier", safety: 2.5, own: {},
  extrapolate: false, level: null, record: null, records: null };
for (const [kind, fields] of Object.entries(KINDS)) state.own[kind] = { ...fields };
let about = null;
let motions = null;
// the records that the page came with, and what the link was made with
let embeddedRecords = null;
let linked = {};

// a number as it is typed; undefined where there is none
function parsed(said, text) {
  const value = text.trim() === "" ? undefined : Number(text);
  if (Number.isNaN(value)) throw new Error(`${said}: ${/^\s*-?\d+,\d+\s*$/.test(text) ? `use a point: ${text.trim().replace(",", ".")}` : "give a number"}.`);
  if (value < 0) throw new Error(`${said}: give a positive number.`);
  return value;
}
// the link into the state; what of it cannot be read
function readLink() {
  const link = new URLSearchParams(location.hash.slice(1));
  const wrong = [];
  const number = (key, fallback) => {
    try { return parsed(key, link.get(key) ?? "") ?? fallback; } catch (error) { wrong.push(error.message); return fallback; }
  };
  for (const key of ["site", "measure", "record", "records"]) state[key] = link.get(key);
  linked = { record: state.record, records: state.records };
  for (const key of ["period", "safety"]) state[key] = number(key, state[key]);
  for (const key of ["strength", "level"]) state[key] = number(key, null);
  state.extrapolate = link.get("extrapolate") === "loglog";
  if (KINDS[link.get("kind")]) state.kind = link.get("kind");
  for (const key of Object.keys({ ...FIELDS, width_m: 0, height_m: 0 })) {
    if (link.has(key) && (key in KINDS[state.kind] || key === "restitution")) state.own[state.kind][key] = number(key, KINDS[state.kind][key]);
  }
  return wrong.length ? `The link: ${labelled(wrong.join(" "))}` : "";
}
function link() {
  const { site, measure, period, safety, kind, strength, level, record, records } = state;
  const all = { site, measure, period, safety, kind };
  for (const [key, value] of Object.entries({ strength, level, record, records })) if (value !== null) all[key] = value;
  if (state.extrapolate) all.extrapolate = "loglog";
  for (const [key, value] of Object.entries(state.own[kind])) if (key !== "kind") all[key] = value ?? "";
  return `#${new URLSearchParams(all)}`;
}
// a page inside a report has no address of its own
const embedded = location.protocol === "about:";
// when nothing was changed for a while: what a drag does not wait for
const rested = (work, pause_ms) => {
  let timer = 0;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(work, pause_ms);
  };
};
const writeLink = rested(() => embedded || mistyped.size || history.replaceState(null, "", link()), 200);
const at = () => ({ site: state.site, measure: state.measure, return_period: state.period });

// ---- charts ---------------------------------------------------------------------------------------------------------
const palette = () => {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(["paper", "ink", "soft", "line", "blue", "band", "red"].map((name) =>
    [name, style.getPropertyValue(`--${name}`).trim()]));
};
const PRINTED = { paper: "#fff", ink: "#1b1e23", soft: "#5a6270", line: "#c8ced7", blue: "#00618f", band: "#b9d8e8", red: "#a4262c" };
function ticks(scale) {
  const { from, to, log } = scale;
  if (log) {
    const decades = [];
    for (let power = Math.ceil(Math.log10(from) - 1e-9); 10 ** power <= to * (1 + 1e-9); power++) decades.push(10 ** power);
    if (decades.length > 2) return decades.length > 7 ? decades.filter((_, place) => place % 2 === 0) : decades;
    const all = [];
    for (let power = Math.floor(Math.log10(from)); power <= Math.log10(to); power++)
      for (const own of [1, 2, 5]) all.push(own * 10 ** power);
    return all.filter((own) => own >= from * (1 - 1e-9) && own <= to * (1 + 1e-9));
  }
  const raw = (to - from) / 5;
  const step = [1, 2, 5, 10].map((own) => own * 10 ** Math.floor(Math.log10(raw))).find((own) => own >= raw);
  const all = [];
  for (let own = Math.ceil(from / step) * step; own <= to + 1e-9 * step; own += step) all.push(Math.abs(own) < 1e-12 ? 0 : own);
  return all;
}
const label = (value) => (value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e5)
  ? String(Number(value.toPrecision(3)).toExponential()).replace("e+", "e") : String(Number(value.toPrecision(3))));
// a figure: series are lines {x, y, colour}, bands {x, low, high} and points {x, y}; null breaks a line
function svgOf(figure, colours) {
  const [wide, high, left, right, top, bottom] = [460, figure.high ?? 320, 62, 14, 14, 48];
  const place = (scale, from, to) => (value) => {
    const own = scale.log ? Math.log(value / scale.from) / Math.log(scale.to / scale.from)
      : (value - scale.from) / (scale.to - scale.from);
    return (from + Math.min(1.5, Math.max(-0.5, own)) * (to - from)).toFixed(1);
  };
  const x = place(figure.x, left, wide - right);
  const y = place(figure.y, high - bottom, top);
  const parts = [`<rect width="${wide}" height="${high}" fill="${colours.paper}"/>`];
  for (const own of ticks(figure.x)) parts.push(`<path d="M${x(own)} ${top}V${high - bottom}" stroke="${colours.line}" stroke-width="0.7"/>`,
    `<text x="${x(own)}" y="${high - bottom + 16}" text-anchor="middle" fill="${colours.ink}">${label(own)}</text>`);
  for (const own of ticks(figure.y)) parts.push(`<path d="M${left} ${y(own)}H${wide - right}" stroke="${colours.line}" stroke-width="0.7"/>`,
    `<text x="${left - 6}" y="${Number(y(own)) + 4}" text-anchor="end" fill="${colours.ink}">${label(own)}</text>`);
  const usable = (scale, value) => value !== null && value !== undefined && Number.isFinite(value) && (!scale.log || value > 0);
  const path = (xs, ys) => {
    let pen = "M";
    return xs.map((own, place) => {
      if (!usable(figure.x, own) || !usable(figure.y, ys[place])) { pen = "M"; return ""; }
      const drawn = `${pen}${x(own)} ${y(ys[place])}`;
      pen = "L";
      return drawn;
    }).join("");
  };
  parts.push(`<clipPath id="clip-${figure.name}"><rect x="${left}" y="${top}" width="${wide - left - right}" height="${high - top - bottom}"/></clipPath>`,
    `<g clip-path="url(#clip-${figure.name})">`);
  for (const { x: xs, low, high: up } of figure.bands ?? []) {
    const there = xs.map((_, place) => place).filter((place) => usable(figure.x, xs[place]) && low[place] !== null);
    const floor = figure.y.from;
    const ceiling = figure.y.to;
    const line = (ys, missing) => there.map((place) => `${x(xs[place])} ${y(usable(figure.y, ys[place]) ? ys[place] : missing)}`);
    if (there.length) parts.push(`<path d="M${[...line(low, floor), ...line(up, ceiling).reverse()].join("L")}Z" fill="${colours.band}"/>`);
  }
  for (const { x: xs, y: ys, colour, dash } of figure.lines) parts.push(`<path d="${path(xs, ys)}" fill="none" stroke="${colours[colour ?? "blue"]}" stroke-width="${dash ? 1 : 2}" stroke-linejoin="round"${dash ? ' stroke-dasharray="5 4"' : ""}/>`);
  parts.push("</g>");
  for (const { x: own, y: height } of figure.points ?? []) if (usable(figure.x, own) && usable(figure.y, height)) parts.push(`<circle cx="${x(own)}" cy="${y(height)}" r="5" fill="${colours.red}" stroke="${colours.paper}" stroke-width="1.5"/>`);
  parts.push(`<rect x="${left}" y="${top}" width="${wide - left - right}" height="${high - top - bottom}" fill="none" stroke="${colours.soft}"/>`,
    `<text x="${(left + wide - right) / 2}" y="${high - 8}" text-anchor="middle" fill="${colours.ink}">${escaped(figure.x.name)}</text>`,
    `<text transform="translate(14 ${(top + high - bottom) / 2}) rotate(-90)" text-anchor="middle" fill="${colours.ink}">${escaped(figure.y.name)}</text>`);
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${wide} ${high}" width="${wide}" height="${high}" role="img" aria-label="${escaped(figure.said)}" font-family="sans-serif" font-size="12"><title>${escaped(figure.said)}</title>${parts.join("")}</svg>`;
}
function save(name, content, type = "text/plain") {
  const anchor = element("a", { href: URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type })), download: name });
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(anchor.href), 10000);
}
const figures = {};
function show(id, figure) {
  const place = $(id);
  if (!place.firstChild) {
    const caption = element("figcaption", {}, element("span"));
    const button = (format, act) => {
      const made = element("button", { type: "button", "aria-label": `${format} of this figure` }, format);
      made.onclick = act;
      caption.append(made);
    };
    const printed = () => svgOf(figures[id], PRINTED);
    button("CSV", () => save(`${figures[id].name}.csv`, csvOf(figures[id]), "text/csv"));
    button("SVG", () => save(`${figures[id].name}.svg`, printed(), "image/svg+xml"));
    button("PNG", async () => save(`${figures[id].name}.png`, await pngOf(printed())));
    place.append(element("div"), caption);
  }
  figures[id] = figure;
  place.firstChild.innerHTML = svgOf(figure, palette());
  place.querySelector("figcaption span").textContent = figure.caption;
}
const csvOf = ({ columns, head }) => [`# ${head}`, Object.keys(columns).join(","),
  ...Object.values(columns)[0].map((_, row) => Object.values(columns).map((column) => column[row] ?? "inf").join(","))].join("\n") + "\n";
async function pngOf(svg) {
  const image = new Image();
  image.src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  await image.decode();
  const canvas = element("canvas", { width: 3 * image.width, height: 3 * image.height });
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  URL.revokeObjectURL(image.src);
  return new Promise((resolve) => canvas.toBlob(resolve));
}
const span = (values, log) => {
  const there = values.filter((own) => own !== null && Number.isFinite(own) && (!log || own > 0));
  return there.length ? [Math.min(...there), Math.max(...there)] : log ? [0.1, 1] : [0, 1];
};

// ---- the spectrum ---------------------------------------------------------------------------------------------------
const measureOf = () => about.measures.find((own) => own.key === state.measure);
const whereWords = (of = at()) => `${of.site}, ${of.return_period} years, by ${measureOf().label}`;
// whether what was asked is still to be shown: an answer of a period that was passed is, while the next is awaited
const asker = () => {
  const [records, { site, measure }] = [about, at()];
  return () => about === records && state.site === site && state.measure === measure;
};
// the level of the site, and of which period it is; none of an end of the curve that the period lies beyond
let siteLevel = null;
let sitePeriod = null;
// the records are listed after the first displacement, which does not wait for them
let unlisted = false;
const drawSpectrum = latest(async () => {
  await showSpectrum();
  if (!unlisted) return;
  unlisted = false;
  listMotions();
});
async function showSpectrum() {
  const strength = state.strength ?? window.design?.read_at_strength;
  showStrength(strength);
  const now = at();
  const stands = asker();
  const ofStructure = state.strength === null;
  let spectrum;
  let point = null;
  let refusal = "";
  try {
    if (mistyped.has("period")) throw new Error(mistyped.get("period"));
    spectrum = await ask({ ask: "spectrum", ...now });
  } catch (error) {
    $("answer").textContent = error.message;
    $("figures").hidden = true;
    $("alarms").replaceChildren();
    siteLevel = null;
    if (state.level === null) noMotion("");
    return;
  }
  try {
    if (strength === undefined) throw new Error("The structure’s dimensions are not valid: correct them, or choose a strength.");
    point = await ask({ ask: "point", at: now, strength });
  } catch (error) { refusal = error.message; }
  if (!stands()) return;
  const period = now.return_period;
  window.shown = { spectrum, point };
  $("figures").hidden = false;
  $("f-fragility").hidden = !point;
  const { unit, label: name } = measureOf();
  const probability = digits(100 * spectrum.risk.poe);
  const value = !point ? refusal : point.u_m === null ? "No displacement has this risk: it is exceeded more often" : metres(point.u_m) + band(point.band_m);
  const ofStrength = `strength ${digits(strength, 3)}${ofStructure ? ` (${state.kind})` : ""}`;
  const covers = point && point.band_m[0] !== null ? " The band covers the choice of records, not the hazard curve." : "";
  const doubts = (point?.alarms ?? []).filter((own) => own.severity === "caution").map((own) => `${own.what.replace(/^./, (first) => first.toUpperCase())}.`);
  if (point && ofStructure) doubts.push(...otherOscillator());
  $("answer").replaceChildren(value,
    element("small", {}, `${now.site}, ${point ? `${ofStrength}, ` : ""}${period} years (${probability} % in ${spectrum.risk.years} years), by ${name}.${covers}`),
    ...doubts.map((own) => element("small", { class: "doubt" }, own)));
  const head = `${about.provenance}; ${whereWords(now)}`;
  const [low, high] = span([...spectrum.u_m, ...spectrum.upper_m], true);
  show("f-spectrum", {
    name: "spectrum", head, said: `Displacement over uplift strength, ${whereWords(now)}: ${value}${point ? ` at ${ofStrength}` : ""}`,
    caption: `Uniform risk spectrum${spectrum.lower_m.some((own) => own !== null) ? ` with its ${Math.round(100 * spectrum.confidence)} % band` : ""}, ${about.records} ${about.synthetic ? "synthetic " : ""}${about.records === 1 ? "record" : "records"}.`,
    x: { name: "Uplift strength η", from: spectrum.strengths.find((own) => own > 0), to: spectrum.strengths.at(-1), log: true },
    y: { name: "Displacement, m", from: Math.max(low * 0.8, high * 1e-4), to: high * 1.25, log: true },
    bands: [{ x: spectrum.strengths, low: spectrum.lower_m, high: spectrum.upper_m }],
    lines: [{ x: spectrum.strengths, y: spectrum.u_m }], points: point ? [{ x: strength, y: point.u_m }] : [],
    columns: { strength: spectrum.strengths, u_m: spectrum.u_m, lower_m: spectrum.lower_m, upper_m: spectrum.upper_m, flag: spectrum.flag },
  });
  const { levels, maf_per_year: rates, level } = spectrum.hazard;
  show("f-hazard", {
    name: "hazard", head, said: `Hazard curve of ${now.site}: ${level === null ? "no level" : `${digits(level)} ${unit}`} once in ${period} years`,
    caption: `Hazard curve. The point is ${level === null ? "outside the curve" : `${digits(level)} ${unit}, exceeded`} once in ${period} years.`,
    x: { name: `${name}, ${unit}`, from: levels[0], to: levels.at(-1), log: true },
    y: { name: "Annual rate of exceedance", from: Math.max(Math.min(...rates), 1e-7), to: Math.max(...rates), log: true },
    lines: [{ x: levels, y: rates }], points: [{ x: level, y: 1 / period }],
    columns: { [`${now.measure}_${unit.replace("/", "_")}`]: levels, maf_per_year: rates },
  });
  if (point) show("f-fragility", {
    name: "fragility", head, said: `Share of the records that exceed ${metres(point.u_m)} over ${name}`,
    caption: point.fragility ? `Fragility: share of the records that exceed ${metres(point.u_m)} at strength ${point.fragility_of_strength}${point.fragility_of_strength === strength ? "" : `, the analysed strength nearest to ${digits(strength, 3)}`}.` : "No fragility: the ordinate is not finite.",
    x: { name: `${name}, ${unit}`, from: point.levels[0], to: point.levels.at(-1), log: true },
    y: { name: "Share of the records", from: 0, to: 1 }, lines: [{ x: point.levels, y: point.fragility ?? [] }],
    columns: { [`${now.measure}_${unit.replace("/", "_")}`]: point.levels, share: point.fragility ?? point.levels.map(() => 0) },
  });
  const isLast = 1 / period < Math.min(...rates) * (1 + 1e-6);
  sitePeriod = level === null && !(isLast && 1 / period > Math.min(...rates) * (1 - 1e-6)) ? null : period;
  siteLevel = level ?? (isLast ? levels.at(-1) : levels[0]);
  if (state.level === null) drawMotionAfter();
  const told = [...(point?.alarms ?? []), ...spectrum.alarms].map((own) => element("li", {}, element("span", { class: "kind" }, `${own.severity === "mistake" ? "mistake?" : own.severity}: `),
    `${own.subject}${own.also.length ? ` (${own.also.length} more)` : ""}: ${own.what}.`));
  if (spectrum.alarms.length) told.push(element("li", { class: "note" }, `The stored warnings were checked only for ${about.poes.map((own) => digits(100 * own)).join(", ")} % in ${about.years} years.`));
  $("alarms").replaceChildren(...(told.length ? told : [element("li", {}, about.synthetic ? "None." : "None. The program checks records and curves in more detail.")]));
}

// ---- the structure --------------------------------------------------------------------------------------------------
const own = () => state.own[state.kind];
function toml() {
  const fields = { ...own() };
  if (fields.tendon_stiffness_n_m > 0) fields.kind = "restrained-frame";
  else delete fields.tendon_stiffness_n_m;
  const lines = [`# A ${state.kind}, from the calculator of uplift in the browser`, `kind = "${fields.kind}"`];
  for (const [key, value] of Object.entries(fields)) if (key !== "kind" && value !== undefined) lines.push(`${key} = ${value}`);
  if (fields.kind === "restrained-frame") lines.push('tendon_anchorage = "foundation"');
  return `${lines.join("\n")}\n`;
}
// lengths of the drawing: those of the structure, and what no structure tells
function scene() {
  // what cannot be drawn is refused by the module, with its message
  const [width, height] = [own().width_m, own().height_m].map((length) => (length > 0 && length < 1e4 ? length : 1));
  const { columns = 1 } = own();
  const deck = own().deck_mass_kg === undefined ? 0 : Math.min(0.12 * height, Math.max(0.05 * height, 0.5 * width));
  const shown = Math.min(5, Math.max(1, Math.round(columns) || 1));
  const spacing = width + Math.max(1.6 * width, 0.28 * height);
  const wide = (shown - 1) * spacing + width;
  return { width, height, deck, shown, spacing, wide, over: deck ? 0.35 * width : 0, tendons: own().tendon_stiffness_n_m > 0 };
}
// the structure with its columns rotated, in metres upwards from the ground; only geometry of the picture
function bodies({ width, height, deck, shown, spacing, wide, over, tendons }, rotation, scale, x, ground, colours) {
  const sign = Math.sign(rotation);
  const angle = Math.abs(rotation);
  const parts = [];
  const [dx, dy] = [width * (1 - Math.cos(angle)) + height * Math.sin(angle), width * Math.sin(angle) + height * (Math.cos(angle) - 1)];
  for (let column = 0; column < shown; column++) {
    const left = x + column * spacing * scale;
    const pivot = sign >= 0 ? left + width * scale : left;
    parts.push(`<g transform="rotate(${(rotation * 180) / Math.PI} ${pivot} ${ground})"><rect x="${left}" y="${ground - height * scale}" width="${width * scale}" height="${height * scale}" fill="${colours.band}" stroke="${colours.ink}" stroke-width="1.3"/>`
      + (tendons ? `<path d="M${left + (width * scale) / 2} ${ground - height * scale + 5}V${ground}" stroke="${colours.blue}" stroke-width="1.6"/>` : "") + "</g>");
  }
  if (deck) parts.push(`<rect x="${x - over * scale + sign * dx * scale}" y="${ground - (height + deck + dy) * scale}" width="${(wide + 2 * over) * scale}" height="${deck * scale}" fill="${colours.line}" stroke="${colours.ink}" stroke-width="1.3"/>`);
  return parts.join("");
}
const groundLine = (y, colours) => `<path d="M10 ${y}H450" stroke="${colours.ink}" stroke-width="1.6"/>${Array.from({ length: 32 }, (_, step) => `<path d="M${20 + 13 * step} ${y}l-6 7" stroke="${colours.soft}" stroke-width="0.8"/>`).join("")}`;
function drawing() {
  const of = scene();
  const colours = palette();
  const [ground, room] = [330, 290];
  const scale = Math.min(280 / (of.wide + 2 * of.over), room / (of.height + of.deck));
  const x = 120 + (300 - of.wide * scale) / 2;
  const top = ground - of.height * scale;
  const dimension = `stroke="${colours.soft}" fill="none"`;
  const named = (text, x, y) => `<text x="${x}" y="${y}" text-anchor="middle" font-size="15" fill="${colours.soft}">${text}</text>`;
  const [middle, base] = [(ground + top) / 2, Math.min(400, Math.max(60, x + (of.width * scale) / 2))];
  const svg = `<svg viewBox="0 0 460 400" role="img" aria-label="Elevation of the ${state.kind}: ${of.width} m wide, ${of.height} m high">${groundLine(ground, colours)}${bodies(of, 0, scale, x, ground, colours)}
    <path d="M95 ${ground}V${top}M90 ${ground}h10M90 ${top}h10" ${dimension}/><path d="M${x} 352H${x + of.width * scale}M${x} 347v10M${x + of.width * scale} 347v10" ${dimension}/>
    ${named("Height, m", 50, middle - 28)}${named("Width, m", base < 180 ? base + 110 : base - 110, 381)}
    ${own().columns > of.shown ? `<text x="440" y="150" text-anchor="end" fill="${colours.ink}">of ${own().columns}</text>` : ""}</svg>`;
  const place = $("drawing");
  if (!place.querySelector("svg")) {
    place.append(element("div"));
    for (const [key, said] of [["height_m", "Height, m"], ["width_m", "Width, m"]]) place.append(input(key, said));
  }
  place.firstChild.innerHTML = svg;
  const put = (key, left, height) => {
    const box = place.querySelector(`#field-${key}`);
    box.style.left = `max(2.75rem, ${(100 * left) / 460}%)`;
    box.style.top = `${(100 * height) / 400}%`;
    if (document.activeElement !== box && !mistyped.has(key)) box.value = own()[key];
  };
  put("height_m", 50, middle);
  put("width_m", base, 376);
}
// what is typed wrong, by field
const mistyped = new Map();
function typed(key, said, text) {
  mistyped.delete(key);
  try {
    const value = parsed(said, text);
    if (value !== undefined || key === "restitution") return value;
    mistyped.set(key, `${said}: give a number.`);
  } catch (error) { mistyped.set(key, error.message); }
  return undefined;
}
function input(key, said) {
  const box = element("input", { id: `field-${key}`, type: "text", inputmode: "decimal", autocomplete: "off", "aria-label": said });
  box.oninput = () => {
    const value = typed(key, said, box.value);
    if (!mistyped.has(key)) own()[key] = value;
    changed();
  };
  return box;
}
function fields() {
  const rows = [];
  for (const [key, said] of Object.entries(FIELDS)) {
    if (!(key in KINDS[state.kind]) && key !== "restitution") continue;
    if (key === "columns" && state.kind === "pier") continue;
    const box = input(key, said);
    box.value = own()[key] ?? "";
    rows.push(element("label", { for: box.id }, said), box);
  }
  const factor = element("input", { id: "safety", type: "text", inputmode: "decimal", autocomplete: "off", value: state.safety });
  factor.oninput = () => {
    const value = typed("safety", "Safety factor", factor.value);
    if (!mistyped.has("safety")) state.safety = value;
    changed();
  };
  rows.push(element("label", { for: "safety" }, "Safety factor on the demand"), factor);
  $("fields").replaceChildren(...rows);
  nameRestitution();
}
function nameRestitution() {
  if (about) $("fields").querySelector("[for=field-restitution]").textContent = `Restitution (empty: ${about.restitution})`;
}
// a message of the module with the labels of the page
const labelled = (message) => Object.entries({ ...FIELDS, width_m: "Width, m", height_m: "Height, m", safety_factor: "Safety factor" })
  .reduce((text, [key, said]) => text.replaceAll(new RegExp(`\`?\\b${key}\\b\`?`, "g"), said), message);
const rows = (name, ...all) => element("div", { class: "table" }, element("table", { "aria-label": name }, element("tbody", {}, ...all.filter(Boolean).map(([said, value, bad]) =>
  element("tr", {}, element("th", { scope: "row" }, said), element("td", { class: `number${bad ? " bad" : ""}` }, value))))));
// the rule that requires the most; none where there are no rules
const governing = ({ rules, governing: place }) => (rules ? [rules[place]] : []);
// a verdict that holds for the best estimate alone
const atUpperEnd = ({ required_capacity_band_m: limits, upper_satisfied: satisfied }) => (satisfied === false
  ? ` (not at the upper limit of the band, which ${limits[1] === null ? "no capacity meets" : `requires ${metres(limits[1])}`})` : "");
const judged = (rule) => (rule.satisfied ? `satisfied${atUpperEnd(rule)}` : "not satisfied");
const verdict = (rule, { capacity_m: capacity }) => `${rule.overturns ? "It overturns: required" : "Required"} capacity ${rule.required_capacity_m === null ? "infinite"
  : metres(rule.required_capacity_m, 3) + band(rule.required_capacity_band_m)}${capacity === null ? "" : `, available ${metres(capacity, 3)}`}: ${judged(rule)}`;
// the verdict of the demand on the structure itself, where it was analysed and has a capacity
const ownVerdict = ({ check, upper_check: upper, demand_m: demand, demand_band_m: limits }, { capacity_m: capacity }) =>
  (check.required_capacity_m === null ? "It overturns by its own demand: not satisfied"
    : `Required capacity ${metres(check.required_capacity_m, 3)} by its own demand of ${metres(demand)}${band(limits)}, available ${metres(capacity, 3)}: ${check.satisfied
      ? `satisfied${upper && !upper.satisfied ? " (not at the upper limit of the band)" : ""}` : "not satisfied"}`);
// the demand read off the spectrum is of the oscillator that the spectrum was computed for
function otherOscillator() {
  const [spectrum_mm, own_mm] = window.design?.uplift_mm ?? [];
  const differing = spectrum_mm ? [`uplift displacement ${digits(spectrum_mm, 3)} mm (structure: ${digits(own_mm, 3)} mm)`] : [];
  const { restitution } = own();
  if (restitution !== undefined && restitution !== about.restitution) differing.push(`restitution ${about.restitution} (structure: ${restitution})`);
  return differing.length ? [`Computed for ${differing.join(" and ")}: analyse the structure itself for its own demand.`] : [];
}
const inputs = () => toml() + JSON.stringify([at(), state.safety]);
let designed = null;
const drawDesign = latest(async () => {
  $("toml").textContent = toml();
  let told;
  let others = [];
  const now = at();
  const stands = asker();
  const { kind, safety } = state;
  // that of another site, measure or kind is not shown meanwhile
  if (!designed?.stands() || designed.kind !== kind) for (const id of ["verdict", "design"]) $(id).replaceChildren();
  try {
    if (mistyped.size) throw new Error([...mistyped.values()].join("\n"));
    const text = toml();
    const by = (measure) => ask({ ask: "structure", text, at: { ...now, measure }, safety_factor: safety });
    told = await by(now.measure);
    const keys = about.sites.find((own) => own.name === now.site).measures.filter((key) => key !== now.measure);
    others = await Promise.all(keys.map(async (key) => [about.measures.find((own) => own.key === key).label, await by(key)]));
  } catch (error) {
    complain("mistake", labelled(error.message));
    $("verdict").textContent = "";
    $("design").replaceChildren();
    window.design = null;
    designed = null;
    if (state.strength === null) drawSpectrum();
    drawMotionAfter();
    return;
  }
  if (!stands() || state.kind !== kind) return;
  window.design = told;
  designed = { told, others, now, safety, stands, kind };
  if (state.strength === null) drawSpectrum();
  drawMotionAfter();
  complain("mistake", "");
  showDesign();
});
function showDesign() {
  const { told, others, now, safety } = designed;
  const found = window.ownDemand;
  const own = found?.check ? found : null;
  const [most] = governing(told);
  const small = (text) => text.replace(/^./, (first) => first.toLowerCase());
  // a measure that asks for more, as the program names it
  const also = others.flatMap(([name, by]) => governing(by).map((rule) => [name, rule, by]))
    .filter(([, rule]) => most && !rule.satisfied && most.satisfied).map(([name, rule, by]) => ` By ${name}, ${small(verdict(rule, by))}.`);
  const kind = `The ${state.kind}: `;
  $("verdict").replaceChildren(...(own ? [element("span", own.check.satisfied ? {} : { class: "bad" }, `${kind}${small(ownVerdict(own, told))}.`)] : []),
    most ? `${own ? " By the spectrum: " : kind}${small(verdict(most, told))}.` : "", element("span", { class: "bad" }, also.join("")));
  $("design").replaceChildren(
    ...(own ? [element("p", { class: `answer${own.check.satisfied ? "" : " bad"}` }, ownVerdict(own, told))] : []),
    ...governing(told).map((rule) => element("p", { class: "answer" }, own ? "By the spectrum: " : "",
      verdict(rule, told), element("small", {}, `By ${rule.rule.replace("-", " ")}, ${whereWords(now)}. ${rule.overturns ? "" : `Displacement of the ${state.kind} ${metres(rule.demand_m)}${band(rule.demand_band_m)}, safety factor ${digits(rule.safety_factor, 3)}, ${digits(safety, 3)} required.`}`))),
    rows(
      "Design by the spectrum",
      ["Uplift strength", `${digits(told.spectral_strength, 3)} (displacements are ${digits(told.participation, 4)} times the spectrum's)`],
      ["Displacement capacity", told.capacity_m === null ? "none: the force does not fall after uplift" : metres(told.capacity_m, 3)],
      told.ordinate_m !== undefined && ["Displacement by the spectrum", `${metres(told.ordinate_m)}${band(told.ordinate_band_m)}`],
      told.without_demand && ["Demand", told.without_demand, true],
      ...(told.rules ?? []).flatMap((rule) => [
        [`Demand, rule of ${rule.rule.replace("-", " ")}`, rule.overturns ? "overturns" : `${metres(rule.demand_m)}${band(rule.demand_band_m)}`, rule.overturns],
        [`Required capacity, ${rule.rule.replace("-", " ")}`, rule.required_capacity_m === null ? "no finite one" : `${metres(rule.required_capacity_m)}${band(rule.required_capacity_band_m)}`],
        [`Verdict, ${rule.rule.replace("-", " ")}`, `${judged(rule)}: safety factor ${digits(rule.safety_factor, 3)}, ${digits(safety, 3)} required`, !rule.satisfied],
      ]),
    ),
    ...(also.length ? [element("p", { class: "bad" }, also.join("").trim())] : []),
    ...(most ? [element("p", { class: "note" }, "The required capacity is the safety factor times the demand that the structure would have with that capacity (Eq. 3.15). It is finite even where the structure overturns with the present one.")] : []),
    ...[...otherOscillator(), ...told.warnings].map((own) => element("p", { class: "note" }, own)),
    element("p", { class: "note" }, `${whereWords(now)}${about.synthetic ? ", synthetic records" : ""}. A satisfied rule is no proof: analyse the structure itself.`),
  );
}
function changed() {
  window.ownDemand = null;
  if ($("progress").hidden) say("");
  writeLink();
  drawing();
  drawDesign();
  $("own-demand").replaceChildren();
  $("command").textContent = `uplift run study.toml && uplift bootstrap results/study.h5 && uplift design structure.toml --urs results/study.h5 --return-period ${state.period} --measure ${state.measure}`;
}
// the spectrum at the structure's strength is drawn when that is known
const everything = () => { if (state.strength !== null) drawSpectrum(); changed(); };

async function analyse(question, done) {
  const [bar, stop] = [$("progress"), $("stop")];
  const buttons = [$("analyse"), $("analyse-records")];
  buttons.forEach((button) => { button.disabled = true; });
  stop.disabled = false;
  bar.hidden = false;
  bar.removeAttribute("value");
  try {
    const told = await done(await send({ kind: "analyse", question }, ({ done: finished, of }) => {
      bar.max = of;
      bar.value = finished;
      say(`${finished} of ${of} records analysed`);
    }));
    say(told ?? "");
  } catch (error) {
    say(error.message === "stopped" ? "Stopped." : labelled(error.message));
  }
  buttons.forEach((button) => { button.disabled = false; });
  stop.disabled = true;
  bar.hidden = true;
}
const often = (event) => {
  if (!event.may_happen) return "no displacement capacity: the force does not fall after uplift";
  const limits = event.band_per_year ? ` (90 % band ${rate(event.band_per_year[0])} to ${rate(event.band_per_year[1])})` : "";
  if (event.per_year === 0) return `no record shows it; at most ${rate(event.at_most_per_year)} a year`;
  return `${rate(event.per_year)} a year${limits}, ${digits(100 * event.probability)} % in ${about.years} years${event.alarm ? `. ${event.alarm}` : ""}`;
};
// what is typed wrong is neither analysed nor saved
function isMistyped() {
  const wrong = mistyped.size ? [...mistyped.values()].join(" ") : window.design ? "" : $("mistake").textContent;
  if (wrong) say(wrong);
  return Boolean(wrong);
}
$("analyse").onclick = () => {
  if (isMistyped()) return undefined;
  const asked = inputs();
  const question = { ask: "analyse-structure", text: toml(), at: at(), block: $("with-block").checked, safety_factor: state.safety };
  return analyse(question, (found) => {
    if (inputs() !== asked) return "The inputs changed during the analysis: analyse again.";
    showOwn(found);
  });
};
function showOwn(found) {
  window.ownDemand = found;
  if (designed) showDesign();
  $("own-demand").replaceChildren(element("h3", {}, `The structure itself: ${state.kind}, ${whereWords()}`), rows(
    "The structure itself",
    ["Demand", found.overturns ? "overturns more often than the return period allows" : `${metres(found.demand_m)}${band(found.demand_band_m)}`, found.overturns],
    found.beyond_capacity && ["Exceeds its capacity", often(found.beyond_capacity)],
    ...found.overturning.map((event) => [`Overturns, ${event.model}`, often(event)]),
    ["Analyses", `${found.analyses}, of ${found.records} records`],
  ));
}
$("stop").onclick = () => worker.postMessage({ kind: "stop" });

// ---- the motion -----------------------------------------------------------------------------------------------------
let moving = null;
// how many records exceed the demand, and which comes nearest: asked when nothing was changed for a while
let near = {};
let nearKey = null;
let nearTimer = 0;
const PAUSE_MS = 400;
function showNear(demand) {
  const isNearest = $("motion").value === String(near.nearest);
  $("near").textContent = `${near.exceeding} of ${near.records} records, scaled to the same level, exceed the demand of ${metres(demand)}${isNearest ? "; this one comes nearest to it" : ""}.`;
}
function noMotion(why) {
  moving = null;
  nearKey = null;
  clearTimeout(nearTimer);
  $("peak").textContent = why;
  for (const id of ["near", "stage", "f-trace", "level-number"]) $(id).replaceChildren();
}
const drawMotion = latest(async () => {
  const level = state.level ?? siteLevel;
  if (!motions?.length || level === null) return;
  const { unit, label: name, levels } = measureOf();
  $("level").max = Math.max(levels.at(-1), level);
  $("level").value = level;
  $("level-site").hidden = state.level === null;
  const scaled = `${name} ${digits(level)} ${unit}${state.level !== null ? ""
    : sitePeriod === null ? `, an end of the hazard curve of ${state.site}` : `, exceeded at ${state.site} once in ${sitePeriod} years`}`;
  $("level-number").textContent = scaled;
  $("level").setAttribute("aria-valuetext", scaled);
  if (mistyped.size) return void noMotion([...mistyped.values()].join(" "));
  let motion;
  // the demand by the rule that the headline has
  const [rule] = governing(window.design ?? {});
  const isOfDemand = rule && !rule.overturns && (state.level !== null || sitePeriod !== null);
  const demand = isOfDemand ? rule.demand_m : null;
  const peaks = { ask: "peaks", text: toml(), measure: state.measure, level, demand_m: demand };
  const key = nearKey = JSON.stringify([peaks, motions]);
  clearTimeout(nearTimer);
  $("near").textContent = "";
  try {
    motion = await ask({ ask: "motion", text: toml(), motion: Number($("motion").value), measure: state.measure, level });
  } catch (error) {
    noMotion(labelled(error.message));
    return;
  }
  moving = motion;
  window.moving = motion;
  $("peak").textContent = motion.overturned ? "It overturns." : motion.peak_m === 0 ? "It does not uplift." : `Largest displacement ${metres(motion.peak_m)}.`;
  if (near.key === key) showNear(demand);
  else if (demand !== null) nearTimer = setTimeout(async () => {
    let found;
    // a record at a time, and no further once something was changed
    do {
      found = await ask(peaks).catch(() => null);
      if (!found || nearKey !== key) return;
      $("near").textContent = `Records compared with the demand: ${found.done} of ${found.of}.`;
    } while (found.done !== undefined);
    near = { key, ...found };
    // a motion that is watched stays
    const isOther = state.record === null && $("motion").value !== String(near.nearest);
    if (!isOther || playing || Number($("time").value) > 0) return showNear(demand);
    $("motion").value = near.nearest;
    drawMotion();
  }, PAUSE_MS);
  const [low, high] = span(motion.displacement_m);
  const reach = Math.max(Math.abs(low), Math.abs(high), 1e-3) * 1.1;
  show("f-trace", {
    name: "motion", high: 240, head: `${motions[Number($("motion").value)].id} scaled to ${name} ${level} ${unit}`,
    said: `Displacement in time: ${$("peak").textContent}`, caption: `Displacement of the top under ${motions[Number($("motion").value)].id}, with the ground's acceleration (grey, to its own scale).`,
    x: { name: "Time, s", from: 0, to: motion.time_s.at(-1) || 1 }, y: { name: "Displacement, m", from: -reach, to: reach },
    lines: [{ x: motion.ground_m_s2.map((_, place) => place * motion.ground_step_s),
      y: motion.ground_m_s2.map((own) => (own * 0.5 * reach) / Math.max(...motion.ground_m_s2.map(Math.abs), 1e-9)), colour: "line" },
    { x: motion.time_s, y: motion.displacement_m }],
    columns: { time_s: motion.time_s, displacement_m: motion.displacement_m, rotation_rad: motion.rotation_rad },
  });
  $("f-trace").querySelector("svg").insertAdjacentHTML("beforeend", `<path class="now" d="M62 14V192" stroke="${palette().red}"/>`);
  $("time").max = motion.time_s.at(-1) ?? 0;
  pose(0);
});
const drawMotionAfter = rested(drawMotion, 150);
function pose(time) {
  $("time").value = time;
  $("time-number").textContent = `${time.toFixed(2)} s`;
  $("time").setAttribute("aria-valuetext", `${time.toFixed(2)} s`);
  const of = scene();
  const colours = palette();
  let place = 0;
  const { time_s: times, rotation_rad: rotations } = moving;
  let [from, to] = [0, times.length - 1];
  while (from < to) {
    place = (from + to + 1) >> 1;
    if (times[place] <= time) from = place; else to = place - 1;
  }
  const rotation = Math.max(-1.57, Math.min(1.57, rotations[from] ?? 0));
  const room = of.height + of.deck;
  const scale = Math.min(240 / room, 300 / (of.wide + 2 * of.over + room * 0.4));
  $("stage").innerHTML = `<svg viewBox="0 0 460 300" role="img" aria-label="The ${state.kind} at ${time.toFixed(1)} s, in true shape">${groundLine(270, colours)}${bodies(of, rotation, scale, 230 - (of.wide * scale) / 2, 270, colours)}</svg>`;
  $("f-trace").querySelector(".now")?.setAttribute("transform", `translate(${(384 * time) / (moving.time_s.at(-1) || 1)} 0)`);
}
let playing = 0;
$("play").onclick = () => {
  if (playing) { cancelAnimationFrame(playing); playing = 0; $("play").textContent = "Play"; return; }
  if (!moving) return;
  const shown = Number($("time").value);
  const begin = performance.now() - 1000 * (shown < (moving.time_s.at(-1) ?? 0) - 0.1 ? shown : 0);
  $("play").textContent = "Pause";
  const frame = (now) => {
    const time = (now - begin) / 1000;
    if (!moving || time > (moving.time_s.at(-1) ?? 0)) { playing = 0; $("play").textContent = "Play"; return; }
    pose(time);
    playing = requestAnimationFrame(frame);
  };
  playing = requestAnimationFrame(frame);
};
$("time").oninput = () => {
  if (playing) $("play").click();
  if (moving) pose(Number($("time").value));
};
async function listMotions() {
  try {
    motions = await ask({ ask: "motions" });
    if (!motions.some((own) => own.id === state.record)) {
      if (linked.record && linked.record === state.record) say([$("state").textContent, `The link’s record ${state.record} is not here.`].join(" ").trim());
      state.record = null;
    }
    linked.record = null;
    $("motion").replaceChildren(...motions.map((own, place) => element("option", { value: place }, `${own.id}: PGV ${digits(own.pgv_cm_s)} cm/s, PGA ${digits(own.pga_g)} g, ${digits(own.duration_s)} s`)));
    $("motion").value = Math.max(0, motions.findIndex((own) => own.id === state.record));
  } catch (error) {
    motions = [];
    $("peak").textContent = error.message;
  }
  drawMotion();
}

// ---- files ----------------------------------------------------------------------------------------------------------
const say = (text) => { $("state").textContent = text; };
// larger files are no curves and no records
const LARGEST = 64e6;
const bytes = async (file) => new Uint8Array(await file.arrayBuffer());
const starts = async (file, letters) => [...await bytes(file.slice(0, letters.length))].every((own, place) => own === letters.charCodeAt(place));
// reads files one after another, drop after drop, and shows what is wrong with each
let reading = Promise.resolve();
const each = (files, work) => (reading = reading.then(() => readEach(files, work)));
async function readEach(files, work) {
  const wrong = [];
  for (const file of files) {
    try {
      if (file.size === 0) throw new Error("the file is empty");
      if (file.size > LARGEST) throw new Error(`${digits(file.size / 1e6, 3)} MB; the page reads files up to ${LARGEST / 1e6} MB`);
      if (await starts(file, "PK\u0003\u0004")) throw new Error("is a zip archive: unpack it, and drop the files in it");
      if (await starts(file, "\u0089HDF")) throw new Error("is a result of the program, which exports it for this page: uplift export RESULT --web");
      await work(file);
    } catch ({ message }) {
      const short = message.length > 600 ? `${message.slice(0, 600)} …` : message;
      wrong.push(short.includes(file.name) ? short : `${file.name}: ${short}`);
    }
  }
  complain("own-mistake", wrong.join("\n"));
}
function complain(id, text) {
  $(id).hidden = !text;
  $(id).textContent = text;
}
const OWN_SITE = "Your site";
let curves = [];
let open = [];
// the curves of the own site, and which is marked of each measure
let used = [];
const marked = {};
// a table that does not say its unit is read when the unit is chosen
async function takeCurves(file, choice) {
  const found = await ask({ ask: "curves", name: file.name, choice }, await bytes(file));
  if (found.open) open.push({ file, choices: found.open });
  const [usable, others] = [true, false].map((known) => found.curves.filter((curve) => about.measures.some((own) => own.key === curve.measure) === known));
  // a file that is dropped again replaces its curves
  curves = curves.filter((own) => !usable.some((other) => other.label === own.label));
  curves.push(...usable);
  for (const { measure, place } of usable) marked[measure] = place;
  await offer();
  if (others.length) throw new Error(`the page has no spectra by the measure of ${others.map((curve) => curve.label).join(", ")}`);
}
// lists the curves, and shows the site that the marked ones make: the last that was dropped, until another is chosen
async function offer() {
  $("found").hidden = !curves.length && !open.length;
  $("extrapolate").checked = state.extrapolate;
  const asked = open.map((of) => {
    const select = element("select", {}, element("option", { value: "" }, "Choose …"), ...of.choices.map((own, place) => element("option", { value: place }, own.label)));
    select.onchange = () => {
      open = open.filter((own) => own !== of);
      each([of.file], (file) => takeCurves(file, of.choices[Number(select.value)].choice)).then(offer);
    };
    return element("div", {}, element("label", {}, `${of.file.name} does not say what it holds: `, select));
  });
  const keys = [...new Set(curves.map((curve) => curve.measure))].filter((key) => about.measures.some((own) => own.key === key));
  const radio = (key, value, said) => {
    const box = element("input", { type: "radio", name: `curve-${key}`, value });
    box.checked = String(marked[key]) === String(value);
    box.onchange = () => { marked[key] = value; return useFound(); };
    return element("div", {}, element("label", {}, box, ` ${said}`));
  };
  $("found-list").replaceChildren(...asked, ...keys.flatMap((key) => {
    const own = curves.filter((curve) => curve.measure === key);
    const name = about.measures.find((known) => known.key === key).label;
    const boxes = own.map((curve) => radio(key, curve.place, `${curve.label}, ${curve.points} points, ${curve.unit}`));
    return [element("div", { role: "radiogroup", "aria-label": name }, ...boxes, ...(keys.length > 1 ? [radio(key, "", `no curve of ${name}`)] : []))];
  }));
  if (curves.length) await useFound();
}
// records that do not name their unit or time step are read when these are given
let unread = [];
let droppedFiles = [];
const noneDropped = () => {
  droppedFiles = [];
  complain("own-mistake", "");
  $("dropped").hidden = true;
  $("beside").hidden = true;
};
async function takeRecord(file) {
  const unit = $("record-unit").value || null;
  const read = async () => ask({ ask: "record", name: file.name, unit, step_s: parsed("Time step", $("record-step").value) ?? null }, await bytes(file));
  const { format, records } = await read().catch((error) => {
    // it waits for a unit or time step that is right
    if (/records without one|time step/i.test(error.message)) unread.push(file);
    throw error;
  });
  droppedFiles.push(`${file.name} (${format})`);
  $("dropped").hidden = false;
  const named = `${droppedFiles.slice(0, 12).join(", ")}${droppedFiles.length > 12 ? ", …" : ""}`;
  $("dropped-count").textContent = `${records} ${records === 1 ? "record" : "records"}: ${named}. Further files are added.`;
}
async function takeStripes(file) {
  const packed = await starts(file, "\u001f\u008b");
  const told = await exchanged(await ask({ ask: "stripes" }, await bytes(packed ? await unpacked(file) : file)));
  say(`${file.name} is shown. ${told}`.trim());
}
const unpacked = (file) => new Response(file.stream().pipeThrough(new DecompressionStream("gzip"))).blob();
// what a dropped file is: an exported result, a hazard curve, else a record, or what a curve may be without a word
async function take(files) {
  $("own").open = true;
  let records = 0;
  await each(files, async (file) => {
    const packed = await starts(file, "\u001f\u008b");
    const head = new TextDecoder().decode(await (packed ? await unpacked(file) : file).slice(0, 4000).arrayBuffer());
    if (/^\s*\{\s*"format":\s*"uplift-web/.test(head)) return takeStripes(file);
    if (/hazard|\bpoe|\bmaf\b|iml|imtls|xvalues/i.test(head) || /\.(nrml|xml|json)$/i.test(file.name)) return takeCurves(file);
    try {
      await takeRecord(file);
      records += 1;
    } catch (error) { await takeCurves(file).catch((other) => { throw /\.csv$/i.test(file.name) ? other : error; }); }
  });
  if (records) await listMotions();
}
// a file that was corrected may be chosen again
const chosen = (id, work) => {
  $(id).onchange = async () => {
    await work([...$(id).files]);
    $(id).value = "";
  };
};
chosen("files-hazard", (files) => each(files, (file) => takeCurves(file)));
const takeRecords = (files) => each(files, takeRecord).then(listMotions);
chosen("files-records", takeRecords);
// one change after another: the files that one has refused are there for the next
let reread = Promise.resolve();
const rereadRecords = async () => {
  try {
    parsed("Time step", $("record-step").value);
    if (unread.length) await takeRecords(unread.splice(0));
  } catch (error) { complain("own-mistake", error.message); }
};
for (const id of ["record-unit", "record-step"]) $(id).onchange = () => { reread = reread.then(() => reading).then(rereadRecords); };
chosen("files-stripes", (files) => each(files, takeStripes));
$("take-paste").onclick = () => each([new File([$("paste").value], "pasted curve")], (file) => takeCurves(file));
const ownSite = (of) => ask({ ask: "site", name: OWN_SITE, curves: of.map((own) => own.place), extrapolate: state.extrapolate });
const namesUsed = () => used.map((own) => own.label).join(", ");
async function useFound() {
  const places = [...$("found-list").querySelectorAll("input:checked")].map((box) => box.value).filter(Boolean).map(Number);
  const chosen = curves.filter((own) => places.includes(own.place));
  try {
    const { notes, about: now } = await ownSite(chosen);
    state.site = OWN_SITE;
    used = chosen;
    await settle(now);
    complain("found-mistake", "");
    say(notes.join(". "));
  } catch (error) {
    complain("found-mistake", `${error.message}${state.site === OWN_SITE && used.length ? `\nShown as before: ${namesUsed()}.` : ""}`);
  }
}
// other stripes: the own site is made again of its curves
async function exchanged(now) {
  noneDropped();
  let refused = "";
  if (used.length) {
    try { ({ about: now } = await ownSite(used)); } catch (error) { refused = `${OWN_SITE}: ${error.message}.`; }
  }
  return [refused, await settle(now)].join(" ").trim();
}
// after a bug nothing is left of what was dropped
async function begunAgain(now) {
  [curves, open, used] = [[], [], []];
  await exchanged(now);
  await offer();
  say("What was dropped on this page is lost: drop it again.");
}
$("extrapolate").onchange = () => { state.extrapolate = $("extrapolate").checked; writeLink(); if (curves.length) useFound(); };
$("analyse-records").onclick = () => analyse({ ask: "analyse-records" }, (now) => {
  $("beside").hidden = false;
  return settle(now);
});
$("forget-records").onclick = async () => {
  await ask({ ask: "no-records" });
  say(await exchanged(await send({ kind: "embedded" })));
};
for (const kind of ["dragover", "dragleave", "drop"]) addEventListener(kind, (event) => {
  event.preventDefault();
  document.body.classList.toggle("over", kind === "dragover");
  if (kind === "drop") take([...event.dataTransfer.files]);
});

// ---- what is taken along --------------------------------------------------------------------------------------------
$("save-study").onclick = async () => {
  if (isMistyped()) return;
  const asked = await ask({ ask: "study", ...at() }).catch((error) => say(error.message));
  if (!asked) return;
  const { files, runs_as_it_is: runs } = asked;
  if ("records.csv" in files) say("Put the record files beside study.toml: records.csv names them.");
  for (const [name, text] of Object.entries(files)) save(name, text);
  if (!runs) say("The study names the record files where the result had them. Put them there, or drop them here and analyse them first.");
};
$("save-structure").onclick = () => isMistyped() || save("structure.toml", toml());
$("save-link").hidden = embedded;
$("save-link").onclick = async () => {
  if (isMistyped()) return;
  const { href } = new URL(link(), location.href);
  try { await navigator.clipboard.writeText(href); say("The link is copied."); } catch { say(href); }
};
$("print").onclick = () => print();
// the head of the printed sheet
function sheet() {
  const today = new Date().toLocaleDateString("en-GB", { day: "numeric", month: "long", year: "numeric" });
  const named = [["Project", $("project").value], ["Prepared by", $("author").value], ["Date", today]].filter(([, value]) => value);
  $("sheet-title").textContent = `Design sheet: ${state.kind}`;
  $("sheet-where").textContent = about ? `${whereWords()}${state.site === OWN_SITE ? `, hazard of ${namesUsed()}` : ""}` : "";
  $("sheet-named").textContent = named.map(([said, value]) => `${said}: ${value}`).join(" · ");
}
addEventListener("beforeprint", sheet);

// ---- controls -------------------------------------------------------------------------------------------------------
async function settle(now) {
  about = now;
  embeddedRecords ??= about.record_set;
  const lost = linked.records && linked.records !== about.record_set
    ? `The link was made with other records (${linked.records}): drop them again. Shown: ${about.record_set}.` : "";
  linked.records = null;
  state.records = about.record_set === embeddedRecords ? null : about.record_set;
  $("answer").textContent = "Computing …";
  nameRestitution();
  const missing = state.site && !about.sites.some((own) => own.name === state.site) ? state.site : null;
  if (!about.sites.some((own) => own.name === state.site)) state.site = (about.sites.find((own) => own.name === "Athens") ?? about.sites[0])?.name;
  $("site").replaceChildren(...about.sites.map((own) => element("option", {}, own.name)));
  $("site").value = state.site;
  measures();
  const { strengths } = about;
  $("strength").max = strengths.length - 1;
  $("synthetic").hidden = !about.synthetic;
  $("provenance").textContent = about.provenance;
  unlisted = true;
  everything();
  return [missing && `${missing} has no hazard curve here${missing === OWN_SITE ? ": drop it again" : ""}. ${state.site} is shown.`, lost].filter(Boolean).join(" ");
}
function measures() {
  const there = about.sites.find((own) => own.name === state.site)?.measures ?? [];
  const before = state.measure;
  const known = about.measures.filter((own) => there.includes(own.key));
  if (!known.some((own) => own.key === state.measure)) state.measure = known[0]?.key;
  $("measure").replaceChildren(...known.map((own) => element("option", { value: own.key }, own.label)));
  $("measure").value = state.measure;
  // a level of another measure has another unit
  if (before && before !== state.measure) state.level = null;
  siteLevel = null;
  $("level").min = measureOf().levels.find((own) => own > 0);
}
// strengths of the spectrum are steps of the slider
function showStrength(strength) {
  const { strengths } = about;
  const apart = strengths.map((own) => Math.abs(own - strength));
  if (strength !== undefined) $("strength").value = apart.indexOf(Math.min(...apart));
  const text = strength === undefined ? "none" : digits(strength, 3);
  $("strength").setAttribute("aria-valuetext", text);
  $("strength-number").textContent = text;
  $("strength-own").checked = state.strength === null;
  $("strength").disabled = false;
}
$("site").onchange = () => { state.site = $("site").value; measures(); everything(); };
$("measure").onchange = () => { state.measure = $("measure").value; state.level = null; measures(); everything(); };
$("period").oninput = () => {
  state.period = Number((10 ** Number($("period").value)).toPrecision(4));
  mistyped.delete("period");
  $("period-number").value = state.period;
  showPeriod();
  everything();
};
$("period-number").oninput = () => {
  const value = typed("period", "Return period, years", $("period-number").value);
  if (!mistyped.has("period")) $("period").value = Math.log10(state.period = value);
  showPeriod();
  everything();
};
const showPeriod = () => $("period").setAttribute("aria-valuetext", `${state.period} years`);
$("strength").oninput = () => { state.strength = about.strengths[Number($("strength").value)]; writeLink(); drawSpectrum(); };
$("strength-own").onchange = () => {
  state.strength = $("strength-own").checked ? null : about.strengths[Number($("strength").value)];
  writeLink();
  drawSpectrum();
};
$("level").oninput = () => { state.level = Number($("level").value); writeLink(); drawMotion(); };
$("level-site").onclick = () => { state.level = null; writeLink(); drawMotion(); };
$("motion").onchange = () => { state.record = motions[Number($("motion").value)].id; writeLink(); drawMotion(); };
for (const box of document.querySelectorAll("[name=kind]")) box.onchange = () => {
  state.kind = box.value;
  for (const key of mistyped.keys()) if (key !== "period") mistyped.delete(key);
  fields();
  changed();
};
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", everything);
// another link is another state
addEventListener("hashchange", async () => { say([begin(), await settle(about)].join(" ").trim()); });
function begin() {
  const wrong = readLink();
  mistyped.clear();
  document.querySelector(`[name=kind][value=${state.kind}]`).checked = true;
  $("period").value = Math.log10(state.period);
  $("period-number").value = state.period;
  showPeriod();
  fields();
  return wrong;
}
(async () => {
  const started = performance.now();
  const wrong = begin();
  try {
    const now = await send({ kind: "start", module: bytesOf("module"), stripes: bytesOf("stripes") });
    document.querySelector("main").hidden = false;
    say([wrong, await settle(now)].join(" ").trim());
    window.ready = performance.now() - started;
  } catch (error) {
    say(`The page could not start: ${error.message}`);
  }
})();
