// Sound, blind test and text of the panel.
const WHILE = 10; // ms; from a slider to its sound, at most one wave in as long

Object.assign(Panel.prototype, {
  sounds(create = false) {
    if (!this.player.context && !create) return;
    const { s, m, compared, values, before, live } = this.state;
    this.player.voice("A", this.model.sound(s, m, compared, before[s]));
    this.player.voice("B", this.model.sound(s, m, values, live[s]));
  },

  // Once for all events of a while: a wave takes longer to make than the levels.
  retune() {
    if (!this.player.voices.B || this.waiting) return;
    this.waiting = setTimeout(() => {
      const { s, m, values, live } = this.state;
      this.waiting = null;
      const sound = this.model.sound(s, m, values, live[s]);
      if (this.page.sliders) this.player.voice("B", sound);  // whose noise changes too
      else this.player.retune("B", sound);
    }, WHILE);
  },

  hear(name) {
    if (!this.player.voices.A) this.sounds(true);
    this.player.ready();
    this.player.hear(name);
    clearTimeout(this.ending);
    if (name && !this.at("loop").checked) this.ending = setTimeout(() => this.hear(null), 4000);
    const shown = this.abx && !this.abx.finished ? null : name;
    ["A", "B", "tone"].forEach((one) => {
      this.at(`hear-${one}`).setAttribute("aria-pressed", String(one === shown));
    });
  },

  buttons() {
    const fullDb = level(0.5 * this.page.full_scale_pa ** 2), toneDb = Math.round(fullDb - 20);
    this.at("gain").textContent = `One gain for all: a sample of 1 is ${this.page.full_scale_pa} Pa, `
      + `a sine of full scale ${fullDb.toFixed(1)} dB. The tone is 1 kHz at ${toneDb} dB: set the `
      + "volume so that a sound level meter at the ear reads that.";
    const peak = Math.sqrt(2 * 4e-10) * 10 ** (toneDb / 20);
    const press = (name, act) => this.at(name).addEventListener("click", act);
    press("hear-A", () => this.hear("A"));
    press("hear-B", () => this.hear("B"));
    press("hear-tone", () => { this.player.tone(peak); this.hear("tone"); });
    press("stop", () => this.hear(null));
    press("reset", () => this.reset());
    this.at("toml").closest("details").addEventListener("toggle", () => this.write());
    press("copy", () => this.copy());
    press("abx-start", () => { this.abx = new Abx(); this.hear(null); this.score(); });
    press("abx-X", () => this.hear(this.abx.x));
    press("abx-is-A", () => { this.abx.answer("A"); this.hear(null); this.score(); });
    press("abx-is-B", () => { this.abx.answer("B"); this.hear(null); this.score(); });
  },

  score() {
    const { abx } = this;
    ["abx-X", "abx-is-A", "abx-is-B"].forEach((name) => { this.at(name).disabled = abx.finished; });
    this.at("abx-score").textContent = abx.score;
  },

  // Where it can be read.
  write() {
    const text = this.at("toml");
    if (text.closest("details").open) text.value = this.toml(this.state.values);
  },

  copy() {
    this.at("toml").select();
    const text = this.at("toml").value;
    if (navigator.clipboard) navigator.clipboard.writeText(text).catch(() => {});
    else document.execCommand("copy");
  },

  // The values as options of a study.
  toml(values) {
    const name = this.page.options[values.option], given = this.model.given(values.option);
    const parts = [];
    const short = (value) => String(Number(value.toPrecision(9)));
    const tried = (value) => `{ value = ${short(value)}, source = "tried on the report's page" }`;
    const moved = ["lateral", "vertical", "loss"].some((key) => values[key] !== given[key]);
    if (values.moment > 0) {
      const { radius_m: radius } = this.page.weight;
      parts.push([
        "[options.weight-tried]", 'kind = "counterweight"',
        `mass_g = ${short((1e3 * values.moment) / radius)}`, `radius_mm = ${short(1e3 * radius)}`,
        `angle_deg = ${short((values.angle * 180) / Math.PI)}`,
        `height_mm = ${short(1e3 * values.height)}`,
      ]);
    }
    if (moved) {
      parts.push([
        "[options.mounts-tried]", 'kind = "redesign"', "",
        "[options.mounts-tried.change.mounts]",
        `lateral_stiffness_n_per_mm = ${tried(values.lateral / 1e3)}`,
        `vertical_stiffness_n_per_mm = ${tried(values.vertical / 1e3)}`,
        `loss_factor_ratio = ${tried(values.loss)}`,
      ]);
    }
    if (!parts.length) return `# As option ${name} of the study: no slider has moved.`;
    const beside = values.option ? [[`# Beside option ${name}, which a study cannot join with it.`]] : [];
    if (parts.length > 1) beside.push(["# Weight and mounts are two options; the sliders show both at once."]);
    return [...beside, ...parts].map((lines) => lines.join("\n")).join("\n\n");
  },
});

async function begin(data) {
  const page = JSON.parse(data.textContent), model = new Model(page, await decoded(page.numbers));
  document.documentElement.classList.add("live");
  const panel = new Panel(document.querySelector(".live-panel"), page, model);
  window.vibroacoustics = { panel, rendered, Voice, Abx };
}

begin(document.getElementById("live-data"));
