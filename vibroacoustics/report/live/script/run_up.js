// The panel of a run-up: reads the map, cuts it, and keeps fields and charts alike.
class RunUpPanel {
  constructor(root, page, runUp) {
    Object.assign(this, { root, page, runUp });
    this.at = (name) => root.querySelector(`[data-live="${name}"]`);
    const unit = `Level in dB re ${page.is_pressure ? "20 µPa" : `1 ${page.unit}`}`;
    this.at("weighting").hidden = !page.is_pressure;
    const ramp = this.at("scale").getContext("2d"), colours = ramp.createImageData(255, 1);
    for (let k = 0; k < 255; k++) colours.data.set(runUp.colour(k / 254), 4 * k);
    ramp.putImageData(colours, 0, 0);
    this.order = page.orders.length ? page.orders[0] : 1;
    this.rpm = runUp.rpm[runUp.blocks >> 1];
    this.hertz = (this.order * this.rpm) / 60;
    this.cuts = {
      "order-cut": cutChart(this.at("order-cut"), "Speed in rpm", unit, "#d55e00"),
      "frequency-cut": cutChart(this.at("frequency-cut"), "Speed in rpm", unit, "#0072b2"),
      "speed-cut": cutChart(this.at("speed-cut"), "Shaft order", unit, "#009e73"),
    };
    this.map = mapChart(this.at("map"), runUp, {
      read: (order, rpm) => this.read(order, rpm),
      cut: (order, rpm) => this.cut(order, rpm),
      lines: () => this.lines(),
    });
    this.fields();
    this.changed(true);
  }

  fields() {
    const changed = (name, act) => this.at(name).addEventListener("change", () => {
      const value = Number(this.at(name).value);
      if (value > 0) { act(value); this.changed(); }
    });
    changed("order", (value) => { this.order = value; });
    changed("frequency", (value) => { this.hertz = value; });
    changed("speed", (value) => { this.rpm = value; });
    this.at("a-weighting").addEventListener("change", () => {
      this.runUp.weighted = this.at("a-weighting").checked;
      this.changed(true);
    });
  }

  words({ order, hertz, rpm, level }) {
    const unit = this.runUp.weighted ? "dB(A)" : `dB re ${this.page.is_pressure ? "20 µPa" : `1 ${this.page.unit}`}`;
    return `Order ${order.toFixed(2)}, ${hertz.toFixed(1)} Hz at ${rpm.toFixed(0)} rpm: `
      + `${level.toFixed(1).replace("-", "−")} ${unit}`;
  }

  read(order, rpm) { this.at("says").textContent = this.words(this.runUp.read(order, rpm)); }

  // Cuts through the line of the map that is nearest.
  cut(order, rpm) {
    const point = this.runUp.read(order, rpm);
    Object.assign(this, { order: point.order, rpm: point.rpm, hertz: point.hertz });
    this.changed();
  }

  changed(anew = false) {
    const { runUp } = this;
    const short = (value) => String(Number(value.toPrecision(5)));
    this.at("order").value = short(this.order);
    this.at("frequency").value = short(this.hertz);
    this.at("speed").value = short(this.rpm);
    if (anew) {
      const top = runUp.top, unit = runUp.weighted ? "dB(A)" : "dB";
      const limits = [10 * Math.floor(top / 10) - SHOWN_DB, 10 * Math.ceil((top + 3) / 10)];
      Object.keys(this.cuts).forEach((name) => { this.at(name).limits = limits; });
      this.at("scale-low").textContent = `${(top - SHOWN_DB).toFixed(0)} ${unit}`;
      this.at("scale-high").textContent = `${top.toFixed(0)} ${unit}`;
      this.read(this.order, this.rpm);
    }
    const titles = {
      "order-cut": `Order ${short(this.order)} over the speed`,
      "frequency-cut": `${short(this.hertz)} Hz over the speed`,
      "speed-cut": `Orders at ${this.rpm.toFixed(0)} rpm`,
    };
    Object.entries(titles).forEach(([name, title]) => {
      this.at(name).querySelector(".u-title").textContent = title;
    });
    this.cuts["order-cut"].draw(() => [runUp.rpm, runUp.orderCut(this.order)]);
    this.cuts["frequency-cut"].draw(() => [runUp.rpm, runUp.frequencyCut(this.hertz)]);
    this.cuts["speed-cut"].draw(() => [runUp.orders, runUp.speedCut(this.rpm)]);
    this.map.redraw(anew);
  }

  // Of the cuts, on the map: an order, a frequency and a speed.
  lines() {
    const { runUp, order, hertz, rpm } = this, [slow, fast] = [runUp.rpm[0], runUp.fastest];
    const curve = Array.from({ length: 101 }, (_, k) => slow + ((fast - slow) * k) / 100)
      .map((speed) => [(60 * hertz) / speed, speed]);
    return [[[order, slow], [order, fast]], curve, [[0, rpm], [runUp.highest, rpm]]];
  }
}
