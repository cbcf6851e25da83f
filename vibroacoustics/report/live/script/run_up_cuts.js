// The charts: the map with its cursor, and cuts through it.
function mapChart(target, runUp, acts) {
  const size = () => ({ width: target.clientWidth || 300, height: 380 });
  const half = runUp.page.line_order / 2;
  let picture = null;
  const draw = (plot) => {
    const { left, top, width, height } = plot.bbox, { ctx } = plot;
    picture = picture || runUp.picture(Math.min(Math.round(height), 600));
    const from = plot.valToPos(-half, "x", true), to = plot.valToPos(runUp.highest + half, "x", true);
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.imageSmoothingEnabled = false;
    ctx.drawImage(picture, from, top, to - from, height);
    acts.lines().forEach((points) => {
      ctx.beginPath();
      points.forEach(([order, rpm]) => ctx.lineTo(plot.valToPos(order, "x", true), plot.valToPos(rpm, "y", true)));
      [[3, "#000000"], [1, "#ffffff"]].forEach(([pixels, colour]) => {
        ctx.lineWidth = pixels * devicePixelRatio;
        ctx.strokeStyle = colour;
        ctx.stroke();
      });
    });
    ctx.restore();
  };
  const moved = (plot) => {
    const { left, top } = plot.cursor;
    if (left >= 0) acts.read(plot.posToVal(left, "x"), plot.posToVal(top, "y"));
  };
  const plot = new uPlot({
    ...size(), title: `Level of ${runUp.page.channel}`, legend: { show: false },
    scales: {
      x: { time: false, range: [0, runUp.highest] },
      y: { range: [runUp.rpm[0], runUp.fastest] },
    },
    axes: [axis("Shaft order", { grid: { show: false } }), axis("Speed in rpm", { size: 56, grid: { show: false } })],
    cursor: { drag: { x: false, y: false }, points: { show: false } },
    series: [{}, { show: false }],
    hooks: { drawClear: [draw], setCursor: [moved] },
  }, [[0, runUp.highest], [runUp.rpm[0], runUp.fastest]], target);
  plot.over.addEventListener("click", () => {
    const { left, top } = plot.cursor;
    if (left >= 0) acts.cut(plot.posToVal(left, "x"), plot.posToVal(top, "y"));
  });
  new ResizeObserver(() => {
    if (target.clientWidth && target.clientWidth !== plot.width) plot.setSize(size());
  }).observe(target);
  return { plot, redraw: (anew) => { if (anew) picture = null; plot.redraw(false); } };
}

function cutChart(target, words, unit, colour) {
  const range = () => target.limits || [0, 1];
  return chart(target, " ", { x: { time: false }, y: { range } },
    [axis(words), axis(unit, { size: 50 })],
    [{ label: "cut", stroke: colour, width: 1.5, points: { show: false } }]);
}
