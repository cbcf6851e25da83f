// Sound of a case: a wave of all orders, an oscillator a tone, noise by third octaves.
const FADE = 0.003; // s; a switch between A and B
const AHEAD = 0.005; // s; from a slider to the new wave
const NOISE_SAMPLES = 1 << 17;

// In place, length a power of two: x_k becomes Σ x_n exp(+2πj kn/N).
function transform(re, im) {
  const n = re.length;
  for (let i = 1, j = 0; i < n; i++) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) {
      let kept = re[i]; re[i] = re[j]; re[j] = kept;
      kept = im[i]; im[i] = im[j]; im[j] = kept;
    }
  }
  for (let size = 2; size <= n; size *= 2) {
    const half = size / 2, step = (2 * Math.PI) / size;
    const cosine = new Float64Array(half), sine = new Float64Array(half);
    for (let k = 0; k < half; k++) { cosine[k] = Math.cos(step * k); sine[k] = Math.sin(step * k); }
    for (let first = 0; first < n; first += size) {
      for (let k = 0; k < half; k++) {
        const a = first + k, b = a + half;
        const x = re[b] * cosine[k] - im[b] * sine[k], y = re[b] * sine[k] + im[b] * cosine[k];
        re[b] = re[a] - x; im[b] = im[a] - y;
        re[a] += x; im[a] += y;
      }
    }
  }
}

// Numbers from 0 to 1 that are the same at every start, so that A and B have the same noise.
function evenly(start) {
  let state = start;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

// Noise that loops without a seam: bands flat between their edges, with phases at random, and as a
// sum the A-weighted energy of the rest. In Pa.
function noiseSamples(bands, squares, rest, rate) {
  const n = NOISE_SAMPLES, re = new Float64Array(n), im = new Float64Array(n), next = evenly(1);
  let energy = 0;
  bands.forEach((middle, band) => {
    const low = Math.ceil((middle * 10 ** -0.05 * n) / rate);
    const high = Math.min(Math.ceil((middle * 10 ** 0.05 * n) / rate), n / 2);
    const square = squares[band] / Math.max(high - low, 1);
    for (let k = low; k < high; k++) {
      const phase = 2 * Math.PI * next(), size = Math.sqrt(2 * square);
      re[k] = size * Math.cos(phase);
      im[k] = size * Math.sin(phase);
      energy += square * aPower((k * rate) / n);
    }
  });
  if (energy === 0) return null;
  transform(re, im);
  const gain = Math.sqrt(rest / energy);
  return Float32Array.from(re, (value) => gain * value);
}

// One case in an audio context, a node to which everything leads, from a time on.
class Voice {
  constructor(context, sound, bands, fullScale, start) {
    Object.assign(this, { context, fullScale, start, shaft: sound.shaft });
    this.out = context.createGain();
    this.sources = [];
    const samples = sound.rest > 0
      ? noiseSamples(bands, sound.noise, sound.rest, context.sampleRate) : null;
    if (samples) {
      const buffer = context.createBuffer(1, samples.length, context.sampleRate);
      buffer.copyToChannel(samples, 0);
      const noise = context.createBufferSource();
      Object.assign(noise, { buffer, loop: true });
      this.begin(noise, this.scale());
    }
    sound.tones.forEach(([hertz, ...peak]) => this.oscillator(hertz, [, peak], start, this.scale()));
    this.orders = null;
    this.retune(sound, start, 0);
  }

  scale(gain = 1) {
    const node = this.context.createGain();
    node.gain.value = gain / this.fullScale;
    return node;
  }

  begin(source, node, when = this.start) {
    source.connect(node).connect(this.out);
    source.start(when);
    this.sources.push(source);
    return { source, node };
  }

  // Harmonics of a frequency, peaks by their number, as they are at a time after the start.
  oscillator(hertz, peaks, when, node) {
    const real = new Float32Array(peaks.length + 1), imag = new Float32Array(peaks.length + 1);
    peaks.forEach(([re, im], k) => {
      const turn = 2 * Math.PI * ((hertz * k * (when - this.start)) % 1);
      real[k] = re * Math.cos(turn) - im * Math.sin(turn);
      imag[k] = -(re * Math.sin(turn) + im * Math.cos(turn));
    });
    const source = this.context.createOscillator();
    source.setPeriodicWave(
      this.context.createPeriodicWave(real, imag, { disableNormalization: true }));
    source.frequency.value = hertz;
    return this.begin(source, node, when);
  }

  // Other orders, faded in at a time.
  retune(sound, when, fade = 0.01) {
    const before = this.orders, node = this.scale();
    this.orders = sound.orders.length ? this.oscillator(this.shaft, sound.orders, when, node) : null;
    if (!before) return;
    slide(node.gain, 0, 1 / this.fullScale, when, fade);
    slide(before.node.gain, 1 / this.fullScale, 0, when, fade);
    before.source.stop(when + fade + 0.01);
    this.sources = this.sources.filter((one) => one !== before.source);
  }

  stop(when) {
    this.sources.forEach((one) => one.stop(when));
  }
}

// A gain that goes straight from one value to another.
function slide(gain, from, to, when, duration) {
  gain.cancelScheduledValues(0);
  gain.setValueAtTime(from, when);
  gain.linearRampToValueAtTime(to, when + duration);
}

// Two voices of which one sounds, and a tone to set the volume by.
class Player {
  constructor(page) {
    this.page = page;
    this.context = null;
    this.voices = {};
    this.playing = null; // "A", "B", "tone" or nothing
  }

  ready() {
    if (!this.context) this.context = new AudioContext();
    if (this.context.state === "suspended") this.context.resume();
    return this.context;
  }

  voice(name, sound) {
    const context = this.ready(), { bands, full_scale_pa: scale } = this.page;
    const when = context.currentTime + AHEAD, before = this.voices[name];
    const voice = new Voice(context, sound, bands, scale, when);
    const heard = this.playing === name;
    voice.out.gain.value = 0;
    if (heard) slide(voice.out.gain, 0, 1, when, FADE);
    voice.out.connect(context.destination);
    if (before) {
      if (heard) slide(before.out.gain, 1, 0, when, FADE);
      before.stop(when + 2 * FADE);
    }
    this.voices[name] = voice;
  }

  retune(name, sound) {
    const voice = this.voices[name];
    if (voice) voice.retune(sound, this.context.currentTime + AHEAD);
  }

  tone(peak) {
    const context = this.ready();
    const sound = { shaft: 1000, orders: [[0, 0], [peak, 0]], tones: [], noise: [], rest: 0 };
    if (!this.voices.tone) this.voice("tone", sound);
    this.hear("tone");
    return context;
  }

  // Only one of the voices, without a gap.
  hear(name) {
    if (!this.context || name === this.playing) return;
    const when = this.context.currentTime;
    const before = this.voices[this.playing], after = this.voices[name];
    if (before) slide(before.out.gain, 1, 0, when, FADE);
    if (after) slide(after.out.gain, 0, 1, when, FADE);
    this.playing = name;
  }
}

// Samples of one case, or of a switch between two, in parts of full scale.
async function rendered(page, sounds, seconds, rate, switched) {
  const context = new OfflineAudioContext(1, Math.round(seconds * rate), rate);
  sounds.forEach((sound, number) => {
    const voice = new Voice(context, sound, page.bands, page.full_scale_pa, 0);
    voice.out.connect(context.destination);
    if (sounds.length === 1) return;
    voice.out.gain.value = number ? 0 : 1;
    slide(voice.out.gain, number ? 0 : 1, number ? 1 : 0, switched, FADE);
  });
  return (await context.startRendering()).getChannelData(0);
}
