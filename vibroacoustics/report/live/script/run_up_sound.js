// Sound of a run-up: orders from their envelopes, the residual from its samples.
const FADE_S = 0.01;

class RunUpSound {
  constructor(data, residual, envelopes) {
    Object.assign(this, { data, coded: residual, envelopes: new Int16Array(envelopes.buffer, 0, envelopes.length >> 1) });
    this.samples = residual.length;
    this.parts = [...data.orders.map((order) => `${Number(order.toPrecision(4))}×`), "residual"];
    this.solo = new Set();
    this.mute = new Set();
    this.gains = [];
  }

  // Places of a sample among the values of the envelopes: four weights of a cubic.
  weights(share) {
    const [s, t] = [share, 1 - share];
    return [-0.5 * s * t * t, 1 + s * s * (1.5 * s - 2.5), 1 + t * t * (1.5 * t - 2.5), -0.5 * t * s * s];
  }

  // Angle of the shaft at every sample, in turns.
  angle() {
    if (this.turns) return this.turns;
    const { shaft_hz: shaft, envelope_rate_hz: rate, rate_hz: played } = this.data;
    const sums = [0];
    for (let k = 1; k < shaft.length; k++) sums.push(sums[k - 1] + (shaft[k - 1] + shaft[k]) / 2 / rate);
    this.turns = new Float64Array(this.samples);
    for (let i = 0; i < this.samples; i++) {
      const place = (i * rate) / played, k = Math.min(Math.floor(place), shaft.length - 2), s = place - k;
      this.turns[i] = sums[k] + (s * (shaft[k] + 0.5 * s * (shaft[k + 1] - shaft[k]))) / rate;
    }
    return this.turns;
  }

  // Samples of an order, in the unit of the channel.
  order(number) {
    const { shaft_hz: shaft, envelope_rate_hz: rate, rate_hz: played, orders, envelope_peaks: peaks } = this.data;
    const n = shaft.length, first = 2 * n * number, scale = peaks[number] / 32767, turns = this.angle();
    const samples = new Float32Array(this.samples), value = (from, k) => this.envelopes[from + Math.min(Math.max(k, 0), n - 1)];
    for (let i = 0; i < this.samples; i++) {
      const place = (i * rate) / played, k = Math.min(Math.floor(place), n - 2), w = this.weights(place - k);
      let re = 0, im = 0;
      for (let j = 0; j < 4; j++) {
        re += w[j] * value(first, k - 1 + j);
        im += w[j] * value(first + n, k - 1 + j);
      }
      const phase = 2 * Math.PI * ((orders[number] * turns[i]) % 1);
      samples[i] = scale * (re * Math.cos(phase) - im * Math.sin(phase));
    }
    return samples;
  }

  residual() {
    const table = Float32Array.from({ length: 256 }, (_, byte) => {
      const size = (byte - 128) / 127;
      return Math.sign(size) * ((256 ** Math.abs(size) - 1) / 255) * this.data.residual_peak;
    });
    return Float32Array.from(this.coded, (byte) => table[byte]);
  }

  // Every part in the unit of the channel, once.
  rendered() {
    if (!this.all) {
      this.all = [...this.data.orders.map((_, number) => this.order(number)), this.residual()];
      let peak = 0;
      for (let i = 0; i < this.samples; i++) {
        let sum = 0;
        for (const part of this.all) sum += part[i];
        peak = Math.max(peak, Math.abs(sum));
      }
      this.fullScale = 1.05 * peak || 1;
    }
    return this.all;
  }

  hears(part) { return this.solo.size ? this.solo.has(part) : !this.mute.has(part); }

  toggle(set, part) {
    if (!set.delete(part)) set.add(part);
    this.gains.forEach((gain, number) => {
      gain.gain.setTargetAtTime(this.hears(number) ? 1 / this.fullScale : 0, this.context.currentTime, FADE_S);
    });
  }

  // Plays all parts from a time of the recording on.
  play(from_s, ended = () => {}) {
    const parts = this.rendered();
    this.stop();
    this.context = this.context || new AudioContext();
    this.context.resume();
    const start = this.context.currentTime + 0.05;
    const offset = Math.min(Math.max(from_s - this.data.start_s, 0), this.samples / this.data.rate_hz);
    this.gains = parts.map((_, number) => new GainNode(this.context, { gain: this.hears(number) ? 1 / this.fullScale : 0 }));
    this.sources = parts.map((samples, number) => {
      this.buffers = this.buffers || [];
      if (!this.buffers[number]) {
        this.buffers[number] = this.context.createBuffer(1, samples.length, this.data.rate_hz);
        this.buffers[number].copyToChannel(samples, 0);
      }
      const source = new AudioBufferSourceNode(this.context, { buffer: this.buffers[number] });
      source.connect(this.gains[number]).connect(this.context.destination);
      source.start(start, offset);
      return source;
    });
    this.sources[0].onended = ended;
    this.begun = start - offset;
  }

  stop() {
    (this.sources || []).forEach((source) => { source.onended = null; source.stop(); });
    this.sources = null;
    this.gains = [];
  }

  // Time of the recording that is heard, s.
  get now() { return this.context.currentTime - this.begun + this.data.start_s; }
}

// Buttons: play from the speed of the cut, stop, solo and mute of every part.
Object.assign(RunUpPanel.prototype, {
  listening(sound) {
    this.sound = sound;
    this.at("sound").hidden = false;
    const body = this.at("parts");
    sound.parts.forEach((name, part) => {
      const row = body.appendChild(document.createElement("div"));
      row.className = "buttons";
      row.appendChild(document.createElement("span")).textContent = name;
      [["Solo", sound.solo], ["Mute", sound.mute]].forEach(([word, set]) => {
        const button = row.appendChild(document.createElement("button"));
        Object.assign(button, { type: "button", textContent: word });
        button.setAttribute("aria-label", `${word} ${name}`);
        button.setAttribute("aria-pressed", "false");
        button.addEventListener("click", () => {
          sound.toggle(set, part);
          button.setAttribute("aria-pressed", String(set.has(part)));
        });
      });
    });
    this.at("play").addEventListener("click", () => this.play());
    this.at("stop").addEventListener("click", () => this.silence());
  },

  play() {
    const { page, runUp, sound } = this;
    sound.play(page.time_s[runUp.rising[runUp.nearest(this.rpm)]], () => this.silence());
    clearInterval(this.clock);
    this.clock = setInterval(() => {
      let block = 0;
      while (block < runUp.blocks - 1 && page.time_s[block + 1] <= sound.now) block++;
      this.at("heard").textContent = `${sound.now.toFixed(1)} s, ${page.speed_rpm[block].toFixed(0)} rpm`;
    }, 100);
  },

  silence() {
    clearInterval(this.clock);
    this.sound.stop();
    this.at("heard").textContent = "";
  },
});
