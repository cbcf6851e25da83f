// Blind tests of two sounds of the page, A and B: X plays one of their files, at random.
class BlindSounds {
  constructor(sounds) {
    this.players = Object.fromEntries(
      ["A", "B"].map((name, number) => [name, sounds.querySelectorAll("audio")[number]]));
    this.hidden = new Audio();
    this.panel = sounds.querySelector("[data-blind=panel]");
    this.panel.hidden = false;
    this.press("start", () => this.start());
    this.press("X", () => this.play());
    ["A", "B"].forEach((name) => this.press(`is-${name}`, () => this.answer(name)));
    Object.values(this.players).forEach((player) => {
      player.addEventListener("play", () => this.hidden.pause());
    });
  }

  at(name) {
    return this.panel.querySelector(`[data-blind=${name}]`);
  }

  press(name, act) {
    this.at(name).addEventListener("click", act);
  }

  start() {
    this.abx = new Abx();
    this.show();
  }

  play() {
    Object.values(this.players).forEach((player) => player.pause());
    this.hidden.src = this.players[this.abx.x].src;
    this.hidden.play();
  }

  answer(name) {
    this.hidden.pause();
    this.abx.answer(name);
    this.show();
  }

  show() {
    ["X", "is-A", "is-B"].forEach((name) => { this.at(name).disabled = this.abx.finished; });
    this.at("score").textContent = this.abx.score;
  }
}

window.blindSounds = [...document.querySelectorAll(".sounds")]
  .filter((sounds) => sounds.querySelector("[data-blind=panel]"))
  .map((sounds) => new BlindSounds(sounds));
