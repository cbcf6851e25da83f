// Begins when all of the script is there.
async function begin(data) {
  const page = JSON.parse(data.textContent), { sound } = page;
  const runUp = new RunUp(page, await unpacked(page.levels));
  document.documentElement.classList.add("live");
  const panel = new RunUpPanel(document.querySelector(".live-panel"), page, runUp);
  panel.line = new DrawnLine(panel);
  if (sound) {
    panel.listening(new RunUpSound(sound, await unpacked(sound.residual), await unpacked(sound.envelopes)));
  }
  window.vibroacoustics = { panel, runUp };
}

begin(document.getElementById("live-data"));
