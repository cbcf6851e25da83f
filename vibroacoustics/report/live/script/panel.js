// The panel: sliders and choices, what they move, sound, and the values as an option.
class Panel {
  constructor(root, page, model) {
    Object.assign(this, { root, page, model, player: new Player(page) });
    this.at = (name) => root.querySelector(`[data-live="${name}"]`);
    this.choices();
    this.sliders();
    this.parameters();
    const limits = this.at("spectrum");
    limits.limits = this.limits();
    this.spectrum = spectrumChart(limits);
    this.speeds = page.speeds.length > 1 ? speedChart(this.at("speeds"), !page.sliders) : null;
    this.at("speeds").hidden = !this.speeds;
    this.buttons();
    this.reset();
  }

  choices() {
    const { options } = this.page;
    const lists = {
      option: [options, 0], compared: [options, 0],
      speed: [this.page.speeds.map((rpm) => `${rpm} rpm`), 0],
      microphone: [this.page.microphones, 0],
    };
    Object.entries(lists).forEach(([name, [words, chosen]]) => {
      const list = this.at(name);
      words.forEach((word, value) => list.add(new Option(word, value, false, value === chosen)));
      list.addEventListener("change", () => (name === "option" ? this.reset() : this.changed(true)));
    });
  }

  // Each slider: least, greatest, step, words for its value; logarithmic ones go by their exponent.
  sliders() {
    const { weight, mounts_move: moves } = this.page;
    const grams = weight ? 1e6 * weight.moment_kg_m : 0;
    const exact = (unit, digits) => (value) => `${value.toFixed(digits)} ${unit}`;
    this.ranges = {
      moment: [0, grams, grams / 200, exact("g mm", grams < 20 ? 2 : 0), 1e-6],
      angle: [0, 359, 1, exact("°", 0), Math.PI / 180],
      height: [0, 1, 1, exact("mm", 0), 1e-3],
      lateral: [-60, 60, 1, exact("N/mm", 2), 1e3],
      vertical: [-60, 60, 1, exact("N/mm", 2), 1e3],
      loss: [0, 0.5, 0.01, exact("", 2), 1],
    };
    if (weight) {
      this.ranges.height.splice(0, 2, ...weight.height_m.map((height) => Math.round(1e3 * height)));
    }
    Object.entries(this.ranges).forEach(([name, [least, greatest, step]]) => {
      const slider = this.at(name);
      const shown = ["moment", "angle", "height"].includes(name) ? weight : moves;
      slider.closest("label").hidden = !shown;
      Object.assign(slider, { min: least, max: greatest, step });
      slider.addEventListener("input", () => {
        slider.dataset.moved = "yes";
        this.changed(false);
      });
    });
    this.at("fixed").hidden = Boolean(moves || this.page.sliders);
    this.at("unmoved").hidden = Boolean(weight || moves || this.page.sliders);
  }

  // What the sliders say, in SI; stiffness to three digits, as the option's text has it.
  values() {
    const option = Number(this.at("option").value), values = this.model.given(option);
    values.positions = this.positions(Number(this.at("speed").value));
    Object.entries(this.ranges).forEach(([name, [, , , words, unit]]) => {
      const slider = this.at(name), number = Number(slider.value);
      if (slider.closest("label").hidden) return;
      if (name === "lateral" || name === "vertical") {
        if (number) values[name] = Number((values[name] * 10 ** (number / 60)).toPrecision(3));
      } else if (name !== "loss" || slider.dataset.moved) values[name] = number * unit;
      const text = words(values[name] / unit), shown = this.at(`${name}-value`);
      if (shown.textContent === text) return;
      shown.textContent = text;
      slider.setAttribute("aria-valuetext", text);
    });
    return values;
  }

  reset() {
    const given = this.model.given(Number(this.at("option").value));
    const { height_m: heights } = this.page.weight || { height_m: [0, 0] };
    const middle = Math.round(500 * (heights[0] + heights[1]));
    const start = { moment: 0, angle: 180, height: middle, lateral: 0, vertical: 0, loss: given.loss };
    Object.entries(start).forEach(([name, value]) => {
      this.at(name).value = value;
      delete this.at(name).dataset.moved;
    });
    (this.inputs || []).forEach(({ input }, k) => { input.value = given.positions[k]; });
    this.changed(true);
  }

  changed(everything) {
    const s = Number(this.at("speed").value), m = Number(this.at("microphone").value);
    const compared = this.model.given(Number(this.at("compared").value)), values = this.values();
    const before = everything ? this.model.every(compared) : this.state.before;
    const live = this.model.every(values, this.state && this.state.live);
    this.state = { s, m, compared, values, before, live };
    this.show(s, m, before, live);
    this.write();
    if (everything) this.sounds();
    else this.retune();
  }

  show(s, m, before, live) {
    const [a, b] = [before[s].of[m], live[s].of[m]], { sliders } = this.page;
    a.line = this.model.lines(s, m, before[s].pressure);
    b.line = this.model.lines(s, m, live[s].pressure);
    this.spectrum.draw(() => spectrum(this.model, s, a, b));
    if (this.speeds) {
      this.speeds.draw(() => overSpeed(this.page.speeds, m, before, live, !sliders));
    }
    const one = this.page.cases[s];
    const loudest = one.frequency.map((_, i) => i)
      .sort((i, j) => Math.max(a.line[j], b.line[j]) - Math.max(a.line[i], b.line[i])).slice(0, 6)
      .sort((i, j) => i - j);
    const rows = [["Total", a.total, b.total]];
    if (!sliders) rows.push(["Modelled", a.modelled, b.modelled]);
    loudest.forEach((i) => {
      const name = one.order[i] ? `${one.order[i]}× (${one.frequency[i].toFixed(1)} Hz)`
        : `${one.frequency[i].toFixed(1)} Hz`;
      rows.push([name, a.line[i], b.line[i]]);
    });
    this.fill("levels", rows);
    this.fill("microphones", this.page.microphones.map(
      (name, i) => [name, before[s].of[i].total, live[s].of[i].total]));
    this.at("says").textContent = `Total ${b.total.toFixed(1)} dB(A), ${change(b.total - a.total)}`
      + (sliders ? " dB" : ` dB; modelled ${b.modelled.toFixed(1)} dB(A), `
        + `${change(b.modelled - a.modelled)} dB`)
      + ` against ${this.page.options[this.state.compared.option]}, at ${this.page.microphones[m]}, `
      + `${this.page.speeds[s]} rpm.${sliders ? this.sliderWords(s, m) : ""}`;
  }

  fill(name, rows) {
    const body = this.at(name);
    while (body.rows.length > rows.length) body.deleteRow(-1);
    rows.forEach(([words, a, b], number) => {
      let row = body.rows[number];
      if (!row) {
        row = body.insertRow();
        const head = row.appendChild(document.createElement("th"));
        head.scope = "row";
        head.className = "words";
        for (let i = 0; i < 3; i++) row.insertCell();
      }
      [words, levelText(a), levelText(b), Math.min(a, b) < SILENT ? "–" : change(b - a)].forEach((text, cell) => {
        if (row.cells[cell].textContent !== text) row.cells[cell].textContent = text;
      });
    });
  }

  // Limits of the spectrum that hold at all sliders: 60 dB under the loudest, 6 above.
  limits() {
    const all = this.page.options.flatMap((_, option) => this.model.every(this.model.given(option)));
    const top = Math.max(...all.flatMap((one) => one.of.map((each) => each.total)));
    return [10 * Math.floor(top / 10) - 60, 10 * Math.ceil((top + 6) / 10)];
  }
}

const SILENT = -20; // dB(A)
const levelText = (value) => (value < SILENT ? "–" : value.toFixed(1).replace("-", "−"));
const change = (value) => (Math.abs(value) < 0.05 ? "0.0"
  : `${value > 0 ? "+" : "−"}${Math.abs(value).toFixed(1)}`);
