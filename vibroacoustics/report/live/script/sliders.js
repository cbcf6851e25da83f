// Sliders of uncertain parameters: changes by third octave, linear between nodes, that add in dB.
Object.assign(Model.prototype, {
  // Sliders that are not at the representative sample.
  moved(values) {
    const { sliders } = this.page;
    return sliders ? sliders.list.filter((one, k) => values.positions[k] !== one.own) : [];
  },

  // Changes of the third octaves at a microphone, dB.
  bandChanges(values, m) {
    const { sliders, bands, microphones } = this.page, sum = new Float64Array(bands.length);
    sliders.list.forEach((one, k) => {
      const lower = Math.min(Math.floor(values.positions[k]), one.values.length - 2);
      const share = values.positions[k] - lower, node = microphones.length * bands.length;
      const first = one.change + lower * node + m * bands.length;
      for (let band = 0; band < sum.length; band++) {
        sum[band] += (1 - share) * this.numbers[first + band] + share * this.numbers[first + node + band];
      }
    });
    return sum;
  },

  // Change of the total level from those of its third octaves, dB.
  totalChange(values, m, changes) {
    const { sliders, bands } = this.page, first = sliders.before[values.option] + m * bands.length;
    let before = 0, after = 0;
    changes.forEach((change, band) => {
      before += 10 ** (this.numbers[first + band] / 10);
      after += 10 ** ((this.numbers[first + band] + change) / 10);
    });
    return 10 * Math.log10(after / before);
  },

  // Lines in place, and noise and total of a microphone, by the changes of the sliders.
  shift(s, m, values, pressure, of) {
    const { bands } = this.page, one = this.page.cases[s], lines = one.frequency.length;
    const changes = this.bandChanges(values, m), first = one.noise[values.option] + m * bands.length;
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
    of.total += this.totalChange(values, m, changes);
    // All of it at the level that is shown.
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
    return several ? error[values.option][m] : moved[0].error;
  },
});

Object.assign(Panel.prototype, {
  errorWords(s, m) {
    const { values } = this.state, error = s === this.page.sliders.speed ? this.model.error(values, m) : 0;
    return error ? ` ± ${Math.max(error, 0.1).toFixed(1)} dB` : " dB";
  },

  parameters() {
    const { sliders } = this.page;
    this.at("sampled").hidden = !sliders;
    if (!sliders) return;
    const first = this.at("moment").closest("label");
    this.inputs = sliders.list.map((one) => {
      const label = document.createElement("label"), output = document.createElement("output");
      const input = Object.assign(document.createElement("input"), {
        type: "range", min: 0, max: one.values.length - 1, step: 0.1, value: one.own,
      });
      input.setAttribute("aria-label", `${one.name}${one.unit ? `, ${one.unit}` : ""}`);
      label.append(`${one.name} `, output, input);
      first.before(label);
      input.addEventListener("input", () => this.changed(false));
      return { input, output };
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
      output.textContent = text;
      input.setAttribute("aria-valuetext", text);
      return position;
    }) : [];
  },
});
