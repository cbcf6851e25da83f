// Levels over speed and order: what is at a point, and the picture of all.
const SHOWN_DB = 60;

class RunUp {
  constructor(page, bytes) {
    Object.assign(this, { page, bytes });
    this.blocks = page.speed_rpm.length;
    this.rising = page.speed_rpm.map((_, block) => block)
      .sort((one, other) => page.speed_rpm[one] - page.speed_rpm[other]);
    this.rpm = this.rising.map((block) => page.speed_rpm[block]);
    this.power = Float64Array.from({ length: 256 },
      (_, byte) => 10 ** ((page.top_db - (255 - byte) * page.step_db) / 10));
    this.weighted = false;
  }

  get fastest() { return this.rpm[this.blocks - 1]; }

  get highest() { return (this.page.lines - 1) * this.page.line_order; }

  // Position of the block whose speed is nearest, among the blocks by rising speed.
  nearest(rpm) {
    let low = 0, high = this.blocks - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.rpm[middle] < rpm) low = middle; else high = middle;
    }
    return rpm - this.rpm[low] <= this.rpm[high] - rpm ? low : high;
  }

  gain(order, rpm) { return this.weighted ? aPower((order * rpm) / 60) : 1; }

  // Mean square of a line over the reference, of the block at a position.
  line(position, line) {
    const byte = this.bytes[line * this.blocks + this.rising[position]];
    return this.power[byte] * this.gain(line * this.page.line_order, this.rpm[position]);
  }

  // What the cursor reads: the nearest line of the nearest block.
  read(order, rpm) {
    const { line_order: step, lines } = this.page;
    const line = Math.min(Math.max(Math.round(order / step), 0), lines - 1);
    const position = this.nearest(rpm);
    const at = { order: line * step, rpm: this.rpm[position] };
    return { ...at, hertz: (at.order * at.rpm) / 60, level: decibel(this.line(position, line)) };
  }

  // Level in the band of an order at every speed, weighted at the order's frequency.
  orderCut(order) {
    const { band_order: band, line_order: step, lines, noise_bandwidth_lines: wide } = this.page;
    const first = Math.max(Math.ceil((order - band / 2) / step - 1e-6), 1);
    const last = Math.min(Math.floor((order + band / 2) / step + 1e-6), lines - 1);
    return this.rising.map((block, position) => {
      let sum = 0;
      for (let line = first; line <= last; line++) sum += this.power[this.bytes[line * this.blocks + block]];
      return decibel((sum / wide) * this.gain(order, this.rpm[position]));
    });
  }

  // Level at a frequency at every speed, between the two lines around it; null beyond the map.
  frequencyCut(hertz) {
    const { first_line: first, lines, line_order: step } = this.page;
    return this.rpm.map((rpm, position) => {
      const place = (60 * hertz) / rpm / step, line = Math.floor(place), share = place - line;
      if (line < first || line + 1 >= lines) return null;
      const [low, high] = [line, line + 1].map((one) => decibel(this.line(position, one)));
      return low + share * (high - low);
    });
  }

  // Orders of the lines without those of an offset.
  get orders() {
    const { first_line: first, lines, line_order: step } = this.page;
    return Array.from({ length: lines - first }, (_, k) => (first + k) * step);
  }

  // Level of each of these lines at a speed.
  speedCut(rpm) {
    const position = this.nearest(rpm), { first_line: first } = this.page;
    return this.orders.map((_, k) => decibel(this.line(position, first + k)));
  }

  get top() {
    let top = 0;
    for (let position = 0; position < this.blocks; position++) {
      for (let line = this.page.first_line; line < this.page.lines; line++) top = Math.max(top, this.line(position, line));
    }
    return decibel(top);
  }

  // A column a line, a row for each of so many speeds, the fastest on top: the loudest block of each.
  picture(rows) {
    const { lines } = this.page, canvas = document.createElement("canvas");
    canvas.width = lines;
    canvas.height = rows;
    const context = canvas.getContext("2d"), image = context.createImageData(lines, rows);
    const slowest = this.rpm[0], each = (this.fastest - slowest) / rows, top = this.top;
    this.topShown = top;
    let from = 0;
    for (let row = rows - 1; row >= 0; row--) {
      const end = slowest + (rows - row) * each, middle = end - each / 2;
      let until = from;
      while (until < this.blocks && this.rpm[until] < end) until++;
      const nearest = this.nearest(middle);
      const [first, last] = until > from ? [from, until - 1] : [nearest, nearest];
      for (let line = 0; line < lines; line++) {
        let most = 0;
        for (let position = first; position <= last; position++) most = Math.max(most, this.line(position, line));
        const share = Math.min(Math.max(1 + (decibel(most) - top) / SHOWN_DB, 0), 1);
        image.data.set(this.colour(share), 4 * (row * lines + line));
      }
      from = until;
    }
    context.putImageData(image, 0, 0);
    return canvas;
  }

  colour(share) {
    const at = 6 * Math.round(254 * share), { palette } = this.page;
    return [0, 2, 4].map((k) => parseInt(palette.slice(at + k, at + k + 2), 16)).concat(255);
  }
}

const decibel = (power) => 10 * Math.log10(Math.max(power, 1e-30));
