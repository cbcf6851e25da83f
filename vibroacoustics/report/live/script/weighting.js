// Weighting A of mean squares (IEC 61672-1:2013, E.6), 1 at 1 kHz.
function aPower(hertz) {
  const gain = (f) => {
    const s = f * f;
    return (s * s) / ((s + 20.598997 ** 2) * (s + 12194.217 ** 2)
      * Math.sqrt((s + 107.65265 ** 2) * (s + 737.86223 ** 2)));
  };
  return (gain(hertz) / gain(1000)) ** 2;
}
