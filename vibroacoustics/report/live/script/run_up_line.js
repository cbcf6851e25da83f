// A line drawn along an order over time and frequency, and the option that repeats it as a speed.
const LINE_ROWS = 400;

class DrawnLine {
  constructor(panel) {
    Object.assign(this, { panel, runUp: panel.runUp, points: [] });
    this.at = panel.at;
    const { time_s: times } = this.runUp.page;
    this.begin = times[0];
    this.end = times[times.length - 1];
    this.top = (this.runUp.highest * this.runUp.fastest) / 60;
    this.at("line-order").value = String(Number(panel.order.toPrecision(5)));
    this.at("line-order").addEventListener("change", () => this.changed());
    this.at("line-back").addEventListener("click", () => { this.points.splice(this.points.indexOf(this.last), 1); this.last = this.points[this.points.length - 1]; this.changed(); });
    this.at("line-clear").addEventListener("click", () => { this.points = []; this.changed(); });
    this.at("line-copy").addEventListener("click", () => this.copy());
    this.at("line-part").addEventListener("toggle", () => this.shown());
  }

  // The chart is made when it is first seen.
  shown() {
    if (this.plot) return;
    const target = this.at("line-map");
    this.plot = frequencyChart(target, this);
    const { over } = this.plot;
    let drawing = false;
    const place = (event) => {
      const box = over.getBoundingClientRect();
      this.add(this.plot.posToVal(event.clientX - box.left, "x"), this.plot.posToVal(event.clientY - box.top, "y"));
    };
    over.addEventListener("pointerdown", (event) => { drawing = true; over.setPointerCapture(event.pointerId); place(event); });
    over.addEventListener("pointermove", (event) => { if (drawing) place(event); });
    ["pointerup", "pointercancel"].forEach((name) => over.addEventListener(name, () => { drawing = false; }));
  }

  // One point in each hundredth of the time; the last one drawn counts.
  add(time, hertz) {
    if (!(hertz > 0)) return;
    const inside = Math.min(Math.max(time, this.begin), this.end), near = (this.end - this.begin) / 100;
    this.last = [inside, hertz];
    this.points = this.points.filter(([other]) => Math.abs(other - inside) >= near).concat([this.last]).sort(([one], [other]) => one - other);
    this.changed();
  }

  get option() {
    const order = Number(this.at("line-order").value);
    if (this.points.length < 2 || !(order > 0)) return "";
    const points = this.points.map(([time, hertz]) => `${time.toFixed(2)}:${((60 * hertz) / order).toFixed(0)}`);
    return `--tacholess-line ${points.join(",")}`;
  }

  changed() {
    this.at("line-option").value = this.option;
    this.at("line-copy").disabled = !this.option;
    this.at("line-copy").textContent = "Copy the option";
    if (this.plot) this.plot.redraw(false);
  }

  copy() {
    this.at("line-option").select();
    document.execCommand("copy");
    this.at("line-copy").textContent = "Copied";
  }

  // A column a block in the order of time, a row a frequency, the highest on top.
  picture() {
    const { runUp } = this, { page, blocks, bytes } = runUp, canvas = document.createElement("canvas");
    canvas.width = blocks;
    canvas.height = LINE_ROWS;
    const context = canvas.getContext("2d"), image = context.createImageData(blocks, LINE_ROWS), top = decibel(runUp.power[255]);
    for (let block = 0; block < blocks; block++) {
      const step = (page.line_order * page.speed_rpm[block]) / 60;
      for (let row = 0; row < LINE_ROWS; row++) {
        const line = Math.round(((LINE_ROWS - row - 0.5) / LINE_ROWS) * (this.top / step));
        if (line < page.first_line || line >= page.lines) continue;
        const level = decibel(runUp.power[bytes[line * blocks + block]]);
        image.data.set(runUp.colour(Math.min(Math.max(1 + (level - top) / SHOWN_DB, 0), 1)), 4 * (row * blocks + block));
      }
    }
    context.putImageData(image, 0, 0);
    return canvas;
  }
}

function frequencyChart(target, line) {
  const size = () => ({ width: target.clientWidth || 300, height: 380 });
  const picture = line.picture();
  const draw = (plot) => {
    const { left, top, width, height } = plot.bbox, { ctx } = plot;
    ctx.save();
    ctx.imageSmoothingEnabled = false;
    ctx.drawImage(picture, left, top, width, height);
    const path = new Path2D(), radius = 3 * devicePixelRatio;
    line.points.forEach(([time, hertz]) => path.lineTo(plot.valToPos(time, "x", true), plot.valToPos(hertz, "y", true)));
    line.points.forEach(([time, hertz]) => {
      const [x, y] = [plot.valToPos(time, "x", true), plot.valToPos(hertz, "y", true)];
      path.moveTo(x + radius, y);
      path.arc(x, y, radius, 0, 2 * Math.PI);
    });
    [[4, "#000000"], [2, "#ffffff"]].forEach(([pixels, colour]) => {
      ctx.lineWidth = pixels * devicePixelRatio;
      ctx.strokeStyle = colour;
      ctx.stroke(path);
    });
    ctx.restore();
  };
  const plot = new uPlot({
    ...size(), title: `Level of ${line.runUp.page.channel} over time and frequency`, legend: { show: false },
    scales: { x: { time: false, range: [line.begin, line.end] }, y: { range: [0, line.top] } },
    axes: [axis("Time in s", { grid: { show: false } }), axis("Frequency in Hz", { size: 56, grid: { show: false } })],
    cursor: { drag: { x: false, y: false }, points: { show: false } },
    series: [{}, { show: false }],
    hooks: { drawClear: [draw] },
  }, [[line.begin, line.end], [0, line.top]], target);
  plot.over.style.touchAction = "none";
  new ResizeObserver(() => {
    if (target.clientWidth && target.clientWidth !== plot.width) plot.setSize(size());
  }).observe(target);
  return plot;
}
