// Two charts: lines and noise over frequency, levels over speed. Grey compared, blue live.
const COLOURS = { compared: "#8c959f", live: "#0b5394", ink: "#1b1f24", grid: "#e3e6ea" };

function axis(label, more = {}) {
  return { label, stroke: COLOURS.ink, grid: { stroke: COLOURS.grid, width: 1 }, labelSize: 22, ...more };
}

// Sticks from the bottom up, moved sideways by some pixels.
function sticks(shift) {
  return (plot, series, first, last) => {
    const path = new Path2D(), [x, y] = [plot.data[0], plot.data[series]];
    const bottom = plot.valToPos(plot.scales.y.min, "y", true);
    for (let i = first; i <= last; i++) {
      if (y[i] == null || y[i] <= plot.scales.y.min) continue;
      const at = Math.round(plot.valToPos(x[i], "x", true)) + shift * devicePixelRatio;
      path.moveTo(at, bottom);
      path.lineTo(at, plot.valToPos(y[i], "y", true));
    }
    return { stroke: path, fill: null, clip: null, flags: 3 };
  };
}

// A plot that is drawn when it is seen, and not before.
function chart(target, title, scales, axes, series) {
  const size = () => ({ width: target.clientWidth || 300, height: 260 });
  const named = series.map((one) => ({
    value: (_, value) => (value == null ? "–" : value.toFixed(1)), ...one,
  }));
  const plot = new uPlot({
    ...size(), title, scales, axes, legend: { live: false }, cursor: { show: false },
    series: [{}, ...named],
  }, [[], ...series.map(() => [])], target);
  new ResizeObserver(() => {
    if (target.clientWidth && target.clientWidth !== plot.width) plot.setSize(size());
  }).observe(target);
  let seen = false, waiting = null;
  const draw = (data) => {
    waiting = data;
    if (!seen || !waiting) return;
    plot.setData(waiting());
    waiting = null;
  };
  new IntersectionObserver((changes) => {
    seen = changes[changes.length - 1].isIntersecting;
    draw(waiting);
  }).observe(target);
  return { draw };
}

function spectrumChart(target) {
  const x = { time: false, distr: 3 };
  return chart(target, "Lines and noise", { x, y: { range: () => target.limits } },
    [axis("Frequency in Hz"), axis("Level in dB(A)", { size: 46 })], [
      { label: "compared", stroke: COLOURS.compared, width: 3, paths: sticks(-2), points: { show: false } },
      { label: "live", stroke: COLOURS.live, width: 3, paths: sticks(2), points: { show: false } },
      { label: "noise, live, third octaves", stroke: COLOURS.ink, dash: [4, 4], width: 1, spanGaps: true,
        points: { show: false } },
    ]);
}

function speedChart(target, modelled) {
  const x = { time: false, range: (_, low, high) => {
    const edge = Math.max(0.05 * (high - low), 50);
    return [low - edge, high + edge];
  } };
  const curve = (label, stroke, more) => (
    { label, stroke, width: 2, points: { show: true, size: 7 }, ...more });
  return chart(target, "Level over speed", { x },
    [axis("Speed in rpm"), axis("Level in dB(A)", { size: 46 })], [
      curve("total, compared", COLOURS.compared), curve("total, live", COLOURS.live),
      curve("modelled, compared", COLOURS.compared, { dash: [6, 4] }),
      curve("modelled, live", COLOURS.live, { dash: [6, 4] }),
    ].slice(0, modelled ? 4 : 2));
}

// Levels of lines and bands over all frequencies of either, rising.
function spectrum(model, s, compared, live) {
  const one = model.page.cases[s], { bands } = model.page;
  const part = bands.map((hertz, band) => live.noise[band] * aPower(hertz));
  const gain = live.rest / Math.max(part.reduce((sum, value) => sum + value, 0), 1e-30);
  const rows = one.frequency.map((hertz, i) => [hertz, compared.line[i], live.line[i], null]);
  bands.forEach((hertz, band) => {
    if (part[band] > 0) rows.push([hertz, null, null, level(gain * part[band])]);
  });
  rows.sort((a, b) => a[0] - b[0]);
  return [0, 1, 2, 3].map((column) => rows.map((row) => row[column]));
}

// Total and modelled levels at a microphone by speed, rising.
function overSpeed(speeds, m, before, live, modelled) {
  const rows = speeds.map((rpm, s) => {
    const [one, other] = [before[s].of[m], live[s].of[m]];
    const total = live[s].unknown ? null : other.total;
    return [rpm, one.total, total, one.modelled, other.modelled];
  });
  rows.sort((one, other) => one[0] - other[0]);
  return [0, 1, 2, 3, 4].slice(0, modelled ? 5 : 3).map((column) => rows.map((row) => row[column]));
}
