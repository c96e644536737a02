// The controls, each with a line that says what it is and how large its effect.

/** A printer point is 0.025 log10 exposure. */
const POINTS = { low: -24, high: 24, step: 1 };

/** Effects, which share their words. */
const EFFECTS = ["grain", "sharpness", "halation"];

export class Controls {
  constructor(state, choices, films, { list, film, more }) {
    Object.assign(this, { state, choices, films });
    this.updates = [];
    list.append(
      this.variant("camera", "Development", "Of the camera film: each time or process is a sheet of its own, with its own contrast."),
      this.variant("print", "Grade", "Of the paper: a harder one has more contrast."),
      this.exposure(),
      this.sceneWhite(),
      this.points(),
      this.density(),
      this.words("aim", "Aim", "What an 18 % grey card becomes: neutral by the printer's lights, or as the print's sheet has it, with its tint."),
      this.words("white", "White", "What counts as white: the clear film, as an eye adapts to it, or the bare lamp, which leaves film's warm tint."),
      this.interImage(),
      this.overexposure(),
    );
    const format = (key, name, help) => this.ofFormat(this.words(key, name, help), key);
    film.append(
      this.words("film_format", "Film format", "How large the picture is on the film: the smaller, the coarser its grain. None leaves all three out.", ["none", "sharpness, halation and grain are left out"]),
      format("grain", "Grain", "Dye clouds. Auto runs it where it can be seen: below the picture is said why not."),
      format("sharpness", "Sharpness", "Light scatters in the film, developing layers sharpen edges: both within some hundredths of a millimetre."),
      format("halation", "Halation", "Light that returns from the film's back makes red rims about lamps. No sheet states how much."),
      this.antihalation(),
      this.seed(),
    );
    more.append(
      this.words("projector", "Seen by", "The light behind or on the film: it shifts all colours together."),
      this.words("gamut", "Colours outside sRGB", "Light that sRGB cannot hold: it lowers exposures smoothly, or is cut. Only strong colours differ."),
      this.words("dyes", "Dyes from densities", "How a sheet's densities become amounts of dye: the last few per cent of saturation."),
      this.words("print_curves", "The print's curves", "What the three curves of a print's sheet are: one neutral scale, or each its own dye."),
      this.words("matching", "Matching", "Whether grey is set on the film's mid grey, or the sheet's own units decide, casts included."),
    );
    state.addEventListener("change", () => this.update());
    this.update();
  }

  update() {
    for (const update of this.updates) update(this.state.keys, this.state.ev);
  }

  exposure() {
    const auto = element("button", { type: "button", id: "auto", textContent: "Auto" });
    auto.addEventListener("click", () => this.auto && this.state.set({ ev: this.auto() }, "auto"));
    const set = (ev) => this.state.set({ ev });
    const turn = this.slider("ev", { low: -8, high: 8, step: 0.1 }, set, (keys, ev) => ev, "Exposure in stops");
    turn.append(auto);
    return control("Exposure", "ev", turn, "In stops: each doubles the light on the film. Auto meters the picture as a photographer would.");
  }

  sceneWhite() {
    const usual = 6500;
    const kelvin = (keys) => (keys.scene_white === "none" ? usual : Number(keys.scene_white.split(",")[0]));
    const set = (value) => this.state.set({ scene_white: value === usual ? "none" : String(value) });
    const turn = this.slider("scene_white", { low: 2000, high: 12000, step: 100 }, set, kelvin, "White of the scene in kelvin");
    return control("White of the scene", "scene_white", turn, "In kelvin: light of this colour becomes neutral. 6500 leaves the picture as it is; 3200 is tungsten, 5000 a low sun.");
  }

  points() {
    const box = element("fieldset", { className: "control", id: "points" });
    box.append(element("legend", { textContent: "Printer lights" }));
    for (const [i, name] of ["Red", "Green", "Blue"].entries()) {
      const set = (value) => this.state.set({ points: this.state.keys.points.with(i, value) }, `points${i}`);
      const turn = this.slider(`points-${i}`, POINTS, set, (keys) => keys.points[i], `${name} printer light in points`);
      turn.prepend(element("label", { htmlFor: `points-${i}`, textContent: name }));
      box.append(turn);
      this.updates.push((keys) => turn.querySelectorAll("input").forEach((input) => (input.disabled = ["none", "scan"].includes(keys.print))));
    }
    const hint = element("p", { className: "hint" });
    this.updates.push((keys) => {
      const unprinted = { none: "Reversal and instant film is not printed: there are no lights to set.", scan: "A scan is balanced on grey by its rule: there are no lights to set." };
      hint.textContent = unprinted[keys.print] ?? "In points of 1/12 stop: more red light makes the print more cyan. Eight points are a plain colour cast.";
    });
    box.append(hint);
    return box;
  }

  density() {
    const set = (value) => this.state.set({ neutral_density: value });
    const turn = this.slider("neutral_density", { low: 0.3, high: 1.3, step: 0.05 }, set, (keys) => keys.neutral_density, "Density of grey");
    this.updates.push((keys) => turn.querySelectorAll("input").forEach((input) => (input.disabled = keys.aim === "sheet")));
    return control("Print density", "neutral_density", turn, "Of an 18 % grey card on the screen: 0.3 more is a stop darker. The sheet's aim has its own.");
  }

  overexposure() {
    const set = (value) => this.state.set({ overexposure: value });
    const turn = this.slider("overexposure", { low: -4, high: 4, step: 0.25 }, set, (keys) => keys.overexposure, "Overexposure in stops");
    return control("Overexposure, printed back", "overexposure", turn, "Stops that a negative is exposed over its speed while the printer keeps grey: shadows open, highlights flatten.");
  }

  interImage() {
    const words = [
      ["film", "the film's own"],
      ["none", "none: each layer by itself"],
      ["negative", "that of colour negatives"],
      ["reversal", "that of reversal films"],
    ];
    const select = element("select", { id: "interimage" });
    for (const [value, textContent] of words) select.append(element("option", { value, textContent }));
    select.addEventListener("change", () => this.attempt({ interimage: select.value }));
    this.updates.push((keys) => show(select, keys.interimage));
    return control("Between layers", "interimage", select, "Layers that develop hold back their neighbours: colours grow purer. Most of film's saturation comes from here.");
  }

  /** Disables a control of the film format where there is none, or `also` says so. */
  ofFormat(box, key, also = () => false) {
    this.updates.push((keys) => box.querySelectorAll("input, select").forEach((input) => (input.disabled = keys.film_format === "none" || also(keys))));
    return box;
  }

  antihalation() {
    const density = (keys) => (keys.antihalation === "none" ? 0 : Number(keys.antihalation));
    const set = (value) => this.state.set({ antihalation: value === 0 ? "none" : String(value) });
    const turn = this.slider("antihalation", { low: 0, high: 3, step: 0.1 }, set, density, "Density of the antihalation layer");
    const box = control("Antihalation layer", "antihalation", turn, "Density of the layer that swallows halation; 0 is film without it, with wide red rims.");
    return this.ofFormat(box, "antihalation", (keys) => keys.halation === "off");
  }

  seed() {
    const set = (value) => this.state.set({ seed: Math.round(value) });
    const turn = this.slider("seed", { low: 0, high: 99, step: 1 }, set, (keys) => keys.seed, "Seed of the grain");
    return this.ofFormat(control("Pattern of the grain", "seed", turn, "Another number, another pattern; its size stays."), "seed", (keys) => keys.grain === "off");
  }

  /** Development times and grades, where a film has several. */
  variant(key, name, help) {
    const select = element("select", { id: `${key}-variant` });
    select.addEventListener("change", () => this.attempt({ [key]: select.value }));
    const box = control(name, `${key}-variant`, select, help);
    let listed;
    this.updates.push((keys) => {
      const [id] = keys[key].split("@");
      const variants = this.films.find((film) => film.id === id)?.variants ?? [];
      box.hidden = variants.length === 0;
      if (listed !== id) {
        listed = id;
        const options = [[id, "the usual"], ...variants.map((variant) => [`${id}@${variant}`, variant])];
        select.replaceChildren(...options.map(([value, textContent]) => element("option", { value, textContent })));
      }
      show(select, keys[key]);
    });
    return box;
  }

  words(key, name, help, first = undefined) {
    const select = element("select", { id: key });
    if (first) select.append(element("option", { value: first[0], textContent: `${first[0]}: ${first[1]}` }));
    for (const { word, help } of this.choices[EFFECTS.includes(key) ? "effect" : key]) select.append(element("option", { value: word, textContent: `${word}: ${help}` }));
    select.addEventListener("change", () => this.attempt({ [key]: select.value }));
    this.updates.push((keys) => show(select, keys[key]));
    return control(name, key, select, help);
  }

  /** A choice may contradict others: then it stays as it was, and the page says why. */
  attempt(keys) {
    try {
      this.state.set(keys);
    } catch (error) {
      this.failed?.(error);
    }
    this.update();
  }

  slider(id, { low, high, step }, set, value, name) {
    const common = { min: low, max: high, step };
    const range = element("input", { type: "range", id, ...common });
    const number = element("input", { type: "number", ...common });
    number.setAttribute("aria-label", `${name}, as a number`);
    range.setAttribute("aria-label", name);
    const take = (text) => {
      const found = Number(text);
      if (text === "" || !Number.isFinite(found)) return;
      set(Math.min(Math.max(found, low), high));
    };
    range.addEventListener("input", () => take(range.value));
    number.addEventListener("change", () => take(number.value));
    range.addEventListener("dblclick", () => set(value(this.state.usual, 0)));
    this.updates.push((keys, ev) => {
      const now = value(keys, ev);
      range.value = now;
      range.setAttribute("aria-valuetext", String(+now.toFixed(2)));
      if (document.activeElement !== number || Number(number.value) !== now) number.value = +now.toFixed(2);
    });
    const turn = element("div", { className: "turn" });
    turn.append(range, number);
    return turn;
  }
}

export function element(tag, properties = {}) {
  return Object.assign(document.createElement(tag), properties);
}

/** Shows a value; one that is not among those offered, as a link may hold, is added as it is. */
function show(select, value) {
  select.querySelector("[data-own]")?.remove();
  if (![...select.options].some((option) => option.value === value)) {
    const own = select.appendChild(element("option", { value, textContent: value }));
    own.dataset.own = "";
  }
  select.value = value;
}

function control(name, id, turn, help) {
  const box = element("div", { className: "control" });
  const hint = element("p", { className: "hint", id: `${id}-help`, textContent: help });
  box.append(element("label", { htmlFor: id, textContent: name }), turn, hint);
  (turn.matches("select") ? turn : turn.querySelector("input"))?.setAttribute("aria-describedby", hint.id);
  return box;
}
