// The controls, each with a line that says what it is and how large its effect.

/** A printer point is 0.025 log10 exposure. */
const POINTS = { low: -24, high: 24, step: 1 };

export class Controls {
  constructor(state, choices, list, more) {
    Object.assign(this, { state, choices });
    this.updates = [];
    list.append(
      this.exposure(),
      this.sceneWhite(),
      this.points(),
      this.density(),
      this.words("aim", "Aim", "What an 18 % grey card becomes: neutral by the printer's lights, or as the print's sheet has it, with its tint."),
      this.words("white", "White", "What counts as white: the clear film, as an eye adapts to it, or the bare lamp, which leaves film's warm tint."),
      this.interImage(),
      this.overexposure(),
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
      this.updates.push((keys) => turn.querySelectorAll("input").forEach((input) => (input.disabled = keys.print === "none")));
    }
    const hint = element("p", { className: "hint" });
    this.updates.push((keys) => {
      hint.textContent =
        keys.print === "none"
          ? "Reversal and instant film is not printed: there are no lights to set."
          : "In points of 1/12 stop: more red light makes the print more cyan. Eight points are a plain colour cast.";
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
    this.updates.push((keys) => {
      const own = words.some(([word]) => word === keys.interimage);
      let option = select.querySelector("[data-own]");
      if (!own) {
        option ??= select.appendChild(element("option"));
        Object.assign(option, { value: keys.interimage, textContent: keys.interimage });
        option.dataset.own = "";
      } else option?.remove();
      select.value = keys.interimage;
    });
    return control("Between layers", "interimage", select, "Layers that develop hold back their neighbours: colours grow purer. Most of film's saturation comes from here.");
  }

  words(key, name, help) {
    const select = element("select", { id: key });
    for (const { word, help } of this.choices[key]) select.append(element("option", { value: word, textContent: `${word}: ${help}` }));
    select.addEventListener("change", () => this.attempt({ [key]: select.value }));
    this.updates.push((keys) => (select.value = keys[key]));
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

function control(name, id, turn, help) {
  const box = element("div", { className: "control" });
  const hint = element("p", { className: "hint", id: `${id}-help`, textContent: help });
  box.append(element("label", { htmlFor: id, textContent: name }), turn, hint);
  (turn.matches("select") ? turn : turn.querySelector("input"))?.setAttribute("aria-describedby", hint.id);
  return box;
}
