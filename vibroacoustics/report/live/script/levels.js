// Lines and levels of a case from the numbers of the page, as the pipeline computes them.
const REFERENCE = 4e-10; // 20 µPa squared, Pa²

// Floats whose first bytes stand first, then the second ones and so on.
async function decoded(text) {
  const planes = await unpacked(text);
  const count = planes.length / 4, sorted = new Uint8Array(planes.length);
  for (let i = 0; i < count; i++) {
    for (let byte = 0; byte < 4; byte++) sorted[4 * i + byte] = planes[byte * count + i];
  }
  return new Float32Array(sorted.buffer);
}

const level = (square) => 10 * Math.log10(Math.max(square, 1e-30) / REFERENCE);

// Solves (a + j b) x = c + j d in place by elimination with row exchange; the answer is in c and d.
function solve(n, a, b, c, d) {
  for (let k = 0; k < n; k++) {
    let row = k, best = -1;
    for (let i = k; i < n; i++) {
      const size = a[i * n + k] ** 2 + b[i * n + k] ** 2;
      if (size > best) { best = size; row = i; }
    }
    if (row !== k) {
      for (let j = k; j < n; j++) {
        let kept = a[k * n + j]; a[k * n + j] = a[row * n + j]; a[row * n + j] = kept;
        kept = b[k * n + j]; b[k * n + j] = b[row * n + j]; b[row * n + j] = kept;
      }
      let kept = c[k]; c[k] = c[row]; c[row] = kept;
      kept = d[k]; d[k] = d[row]; d[row] = kept;
    }
    const re = a[k * n + k] / best, im = -b[k * n + k] / best; // 1/pivot
    for (let i = k + 1; i < n; i++) {
      const p = a[i * n + k], q = b[i * n + k];
      if (p === 0 && q === 0) continue;
      const x = p * re - q * im, y = p * im + q * re;
      for (let j = k + 1; j < n; j++) {
        const u = a[k * n + j], v = b[k * n + j];
        a[i * n + j] -= x * u - y * v;
        b[i * n + j] -= x * v + y * u;
      }
      const u = c[k], v = d[k];
      c[i] -= x * u - y * v;
      d[i] -= x * v + y * u;
    }
  }
  for (let k = n - 1; k >= 0; k--) {
    for (let j = k + 1; j < n; j++) {
      const p = a[k * n + j], q = b[k * n + j];
      const u = c[j], v = d[j];
      c[k] -= p * u - q * v;
      d[k] -= p * v + q * u;
    }
    const p = a[k * n + k], q = b[k * n + k], size = p * p + q * q, u = c[k], v = d[k];
    c[k] = (u * p + v * q) / size;
    d[k] = (v * p - u * q) / size;
  }
}

class Model {
  constructor(page, numbers) {
    Object.assign(this, { page, numbers });
    this.weighting = page.cases.map((one) => one.frequency.map(aPower));
    const n = Math.max(0, ...(page.mounts || []).map((one) => one.size));
    const room = (size) => new Float64Array(size);
    this.room = { a: room(n * n), b: room(n * n), c: room(n), d: room(n), six: room(12), force: room(6) };
  }

  // Values of an option as the run has them.
  given(option) {
    const { mounts, machine } = this.page;
    const [lateral, vertical, loss] = mounts ? mounts[machine[option]].values : [0, 0, 0];
    const positions = this.page.sliders ? this.page.sliders.list.map((one) => one.own) : [];
    return { option, moment: 0, angle: 0, height: 0, lateral, vertical, loss, positions };
  }

  // Load of the option and of a weight at a line into six complex numbers; whether there is one.
  load(one, values, line, sum) {
    const { numbers } = this, { option } = values;
    const first = one.load[option] + 12 * line;
    for (let i = 0; i < 12; i++) sum[i] = numbers[first + i];
    if (one.weight && values.moment > 0) this.weight(one.weight[option] + 12 * line, values, sum);
    return sum.some((value) => value !== 0);
  }

  // The unit weight's force turned about the shaft, and its moment about the centre of mass.
  weight(unit, values, sum) {
    const { numbers } = this, { force } = this.room, { origin_m: origin, shaft } = this.page.weight;
    const { moment, height } = values;
    const along = moment * Math.cos(values.angle), across = moment * Math.sin(values.angle);
    for (let i = 0; i < 3; i++) {
      const j = (i + 1) % 3, k = (i + 2) % 3;
      for (let part = unit; part < unit + 2; part++) {
        force[2 * i + part - unit] = along * numbers[part + 2 * i]
          + across * (shaft[j] * numbers[part + 2 * k] - shaft[k] * numbers[part + 2 * j]);
      }
    }
    for (let i = 0; i < 3; i++) {
      const j = (i + 1) % 3, k = (i + 2) % 3;
      const y = origin[j] + height * shaft[j], z = origin[k] + height * shaft[k];
      for (let part = 0; part < 2; part++) {
        sum[2 * i + part] += force[2 * i + part];
        sum[6 + 2 * i + part] += y * force[2 * k + part] - z * force[2 * j + part]
          + moment * numbers[unit + 6 + 2 * i + part];
      }
    }
  }

  // Velocity of the body on the feet, in place of the load on that with the mechanism.
  velocity(values, six, hertz, line, stiffness) {
    const machine = this.page.machine[values.option], mounts = this.page.mounts[machine];
    const n = mounts.size, omega = 2 * Math.PI * hertz, { a, b, c, d } = this.room;
    const { lateral, vertical, loss } = values;
    for (let i = 0; i < n * n; i++) {
      const springs = lateral * mounts.lateral[i] + vertical * mounts.vertical[i];
      a[i] = springs + mounts.elastic[i] - omega * omega * mounts.mass[i];
      b[i] = loss * springs + mounts.elastic_loss[i] + omega * mounts.damping[i];
    }
    if (stiffness) this.stiffen(stiffness[machine] + 42 * line, mounts, omega);
    c.fill(0);
    d.fill(0);
    const first = mounts.mechanism;
    for (let i = 0; i < 6; i++) { c[first + i] = six[2 * i]; d[first + i] = six[2 * i + 1]; }
    solve(n, a, b, c, d);
    for (let i = 0; i < 6; i++) { six[2 * i] = -omega * d[i]; six[2 * i + 1] = omega * c[i]; }
  }

  // The body on the feet, where their stiffness changes with frequency: a lower triangle by rows.
  stiffen(at, mounts, omega) {
    const { numbers } = this, { a, b } = this.room, n = mounts.size;
    for (let i = 0; i < 6; i++) {
      for (let j = 0; j <= i; j++, at += 2) {
        a[i * n + j] = a[j * n + i] = numbers[at] - omega * omega * mounts.mass[i * n + j];
        b[i * n + j] = b[j * n + i] = numbers[at + 1] + omega * mounts.damping[i * n + j];
      }
    }
  }

  // Modelled complex peaks in Pa at every microphone and line of a speed, real and imaginary in turn,
  // into an array where there is one.
  pressure(s, values, before) {
    const one = this.page.cases[s], lines = one.frequency.length, { numbers } = this, { six } = this.room;
    const microphones = this.page.microphones.length, given = one.pressure[values.option];
    const sound = before ? before.fill(0) : new Float64Array(2 * microphones * lines);
    if (given >= 0) sound.set(numbers.subarray(given, given + sound.length));
    if (!one.load) return sound;
    const factor = one.factor[values.option];
    for (let line = 0; line < lines; line++) {
      if (!this.load(one, values, line, six)) continue;
      this.velocity(values, six, one.frequency[line], line, one.stiffness);
      const left = factor < 0 ? 1 : numbers[factor + line];
      let at = one.vector + 12 * microphones * line;
      for (let m = 0; m < microphones; m++) {
        let re = 0, im = 0;
        for (let i = 0; i < 12; i += 2, at += 2) {
          const p = numbers[at], q = numbers[at + 1];
          re += p * six[i] - q * six[i + 1];
          im += p * six[i + 1] + q * six[i];
        }
        sound[2 * (m * lines + line)] += left * re;
        sound[2 * (m * lines + line) + 1] += left * im;
      }
    }
    return sound;
  }

  // The orders of a baseline, in place: measured, less the model without an option, plus that with it;
  // with the phase of the model.
  overMeasured(s, values, sound) {
    const { numbers } = this, one = this.page.cases[s], lines = one.frequency.length;
    const factor = one.factor[values.option];
    for (let i = 0; i < sound.length / 2; i++) {
      const amplitude = factor < 0 ? 1 : numbers[factor + (i % lines)];
      const re = amplitude * numbers[one.left + 2 * i], im = amplitude * numbers[one.left + 2 * i + 1];
      const [p, q] = [sound[2 * i], sound[2 * i + 1]], before = Math.hypot(p, q);
      const after = numbers[one.phase + i] ? Math.hypot(re + p, im + q) : Math.hypot(re, before);
      sound[2 * i] = before ? (p * after) / before : after;
      sound[2 * i + 1] = before ? (q * after) / before : 0;
    }
  }

  // A-weighted mean square of all lines at each microphone, Pa².
  squares(s, pressure) {
    return this.page.microphones.map((_, m) => {
      let sum = 0;
      for (let i = 0; i < this.weighting[s].length; i++) sum += this.square(s, m, i, pressure);
      return sum;
    });
  }

  // A-weighted mean square of a line at a microphone, Pa².
  square(s, m, i, pressure) {
    const at = 2 * (m * this.weighting[s].length + i), re = pressure[at], im = pressure[at + 1];
    return 0.5 * (re * re + im * im) * this.weighting[s][i];
  }

  // Levels in dB(A) at every microphone of a speed, total and modelled, and the pressure.
  levels(s, values, before) {
    const one = this.page.cases[s], { option } = values;
    const pressure = this.pressure(s, values, before), modelled = this.squares(s, pressure);
    if (one.left !== undefined) this.overMeasured(s, values, pressure);
    const all = one.left === undefined ? modelled : this.squares(s, pressure);
    const { microphones, bands, sliders } = this.page;
    const of = microphones.map((_, m) => {
      const first = one.noise[option] + m * bands.length;
      return {
        total: level(this.numbers[one.rest[option] + m] + all[m]),
        modelled: sliders ? null : level(this.numbers[one.modelled[option] + m] + (one.load ? modelled[m] : 0)),
        rest: Math.max(this.numbers[one.rest[option] + m], 0),
        noise: Array.from(this.numbers.subarray(first, first + bands.length)),
      };
    });
    const moved = this.moved(values).length > 0, moves = moved && s === sliders.speed;
    if (moves) of.forEach((each, m) => this.shift(s, m, values, pressure, each));
    return { pressure, of, unknown: moved && !moves };
  }

  // Of all speeds, into the arrays of such ones that are needed no more.
  every(values, before) {
    return this.page.speeds.map((_, s) => this.levels(s, values, before && before[s].pressure));
  }

  // Level in dB(A) of each line at a microphone.
  lines(s, m, pressure) {
    return Array.from(this.weighting[s], (_, i) => level(this.square(s, m, i, pressure)));
  }

  // What a microphone hears: orders by number, other tones, noise.
  sound(s, m, values, levels = this.levels(s, values)) {
    const one = this.page.cases[s], lines = one.frequency.length, { pressure } = levels;
    const orders = [], tones = [];
    for (let i = 0; i < lines; i++) {
      const at = 2 * (m * lines + i), peak = [pressure[at], pressure[at + 1]];
      if (Number.isInteger(one.order[i])) orders[one.order[i]] = peak;
      else tones.push([one.frequency[i], ...peak]);
    }
    const { noise, rest } = levels.of[m];
    return { shaft: this.page.speeds[s] / 60, orders, tones, noise, rest };
  }
}
