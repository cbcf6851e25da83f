// Sliders: each gives all samples one value. Changes are linear between nodes and add in dB.
Object.assign(Model.prototype, {
  moved(values) {
    const { sliders } = this.page;
    return sliders ? [...sliders.list.keys()].filter((k) => values.positions[k] !== sliders.list[k].own) : [];
  },

  // Changes in the samples: of each third octave in the median, and of the total, dB.
  changes(values, m) {
    const { sliders, bands, microphones } = this.page, { numbers } = this, size = bands.length;
    const node = sliders.samples * microphones.length * size, of = [], total = [];
    for (let sample = 0; sample < sliders.samples; sample++) {
      const row = (sample * microphones.length + m) * size;
      const sum = Array(size).fill(0);
      this.moved(values).forEach((k) => {
        const one = sliders.list[k], at = values.positions[k];
        const lower = Math.min(Math.floor(at), one.values.length - 2), share = at - lower;
        const first = one.change + lower * node + row;
        sum.forEach((_, band) => {
          sum[band] += (1 - share) * numbers[first + band] + share * numbers[first + node + band];
        });
      });
      const first = sliders.before[values.option] + row;
      const energy = (extra) => sum.reduce(
        (all, change, band) => all + 10 ** ((numbers[first + band] + extra * change) / 10), 0);
      of.push(sum);
      total.push(10 * Math.log10(energy(1) / energy(0)));
    }
    return { bands: bands.map((_, band) => quantile(of.map((each) => each[band]), 0.5)), total };
  },

  change(values, m) {
    const { total } = this.changes(values, m), error = this.error(values, m);
    return [quantile(total, 0.1) - error, quantile(total, 0.5), quantile(total, 0.9) + error];
  },

  // Lines in place, and noise and total of a microphone, by the changes of the sliders.
  shift(s, m, values, pressure, of) {
    const { bands } = this.page, one = this.page.cases[s], lines = one.frequency.length;
    const { bands: changes, total } = this.changes(values, m), first = one.noise[values.option] + m * bands.length;
    const numbers = one.frequency.map((hertz) => Math.round(10 * Math.log10(hertz || 1)));
    const column = new Map(bands.map((hertz, band) => [Math.round(10 * Math.log10(hertz)), band]));
    let square = 0, before = 0, after = 0;
    for (let i = 0; i < lines; i++) {
      const gain = 10 ** ((changes[column.get(numbers[i])] || 0) / 20), at = 2 * (m * lines + i);
      pressure[at] *= gain;
      pressure[at + 1] *= gain;
      square += this.square(s, m, i, pressure);
    }
    of.noise = bands.map((hertz, band) => {
      const noise = this.numbers[first + band], louder = noise * 10 ** (changes[band] / 10);
      before += noise * aPower(hertz);
      after += louder * aPower(hertz);
      return louder;
    });
    of.total += quantile(total, 0.5);
    of.rest = (of.rest * after) / Math.max(before, 1e-30);
    const louder = (10 ** (of.total / 10) * REFERENCE) / Math.max(square + of.rest, 1e-30);
    of.rest *= louder;
    for (let i = 2 * m * lines; i < 2 * (m + 1) * lines; i++) pressure[i] *= Math.sqrt(louder);
  },

  // Error of the change, dB: of the interpolation of one slider, or of adding several.
  error(values, m) {
    const moved = this.moved(values), { error } = this.page.sliders;
    if (!moved.length) return 0;
    const several = moved.length > 1 || values.option;
    return several ? error[values.option][m] : this.page.sliders.list[moved[0]].error;
  },
});

Object.assign(Panel.prototype, {
  sliderWords(s, m) {
    const { values } = this.state, moved = this.model.moved(values).length;
    if (!moved || s !== this.page.sliders.speed) return "";
    const [low, middle, high] = this.model.change(values, m).map(change);
    return ` The slider${moved > 1 ? "s make" : " makes"} ${middle} dB (${low} to ${high}).`;
  },

  parameters() {
    const { sliders } = this.page;
    this.at("sampled").hidden = !sliders;
    if (!sliders) return;
    this.inputs = sliders.list.map((one) => {
      const label = document.createElement("label"), output = document.createElement("output");
      const input = Object.assign(document.createElement("input"), {
        type: "range", min: 0, max: one.values.length - 1, step: 0.1, value: one.own,
      });
      input.setAttribute("aria-label", `${one.name}${one.unit ? `, ${one.unit}` : ""}`);
      label.append(`${one.name} `, output, input);
      this.at(one.chosen ? "chosen" : "unknown").before(label);
      input.addEventListener("input", () => this.changed(false));
      return { input, output };
    });
    ["chosen", "unknown"].forEach((name) => {
      const has = sliders.list.some((one) => one.chosen === (name === "chosen"));
      this.at(`${name}-heading`).hidden = !has;
    });
    this.at("toml").closest("details").hidden = true;
    this.at("speed").value = sliders.speed;
  },

  // Where the sliders are, from node to node, with their values in words.
  positions(s) {
    const { sliders } = this.page;
    return sliders ? sliders.list.map((one, k) => {
      const { input, output } = this.inputs[k], position = Number(input.value);
      const lower = Math.min(Math.floor(position), one.values.length - 2), share = position - lower;
      const value = (1 - share) * one.values[lower] + share * one.values[lower + 1];
      const text = `${Number(value.toPrecision(3))} ${one.unit}`.trim().replace("-", "−");
      input.disabled = s !== sliders.speed;
      output.textContent = position === one.own ? one.sampled : text;
      input.setAttribute("aria-valuetext", output.textContent);
      return position;
    }) : [];
  },
});

const quantile = (values, share) => {
  const rising = [...values].sort((a, b) => a - b), at = share * (rising.length - 1);
  const lower = Math.floor(at), upper = Math.min(lower + 1, rising.length - 1);
  return rising[lower] + (at - lower) * (rising[upper] - rising[lower]);
};
