"""Rate narrow-band spectra with phonometry, in a Python of its own (3.13 or newer).

Reads JSON on stdin: `step_hz`, `frequency_hz` (line) and `level_db` (spectrum, line); writes
the decisive audibility of each spectrum, the mean audibility and the adjustment.
"""

import json
import sys

from phonometry.environmental.measurement import tonal_adjustment_from_mean_audibility
from phonometry.psychoacoustics import analyze_spectrum, mean_audibility

NO_TONE_DB = -10.0
LOWEST_HZ = 90.0


def decisive_db(level_db, frequency_hz, step_hz):
    """Largest audibility of a spectrum; phonometry refuses a spectrum without one."""
    try:
        rated = analyze_spectrum(level_db, frequency_hz, step_hz)
    except ValueError as error:
        if "No audible tone" not in str(error):
            raise
        return NO_TONE_DB
    tones = zip(rated.tone_frequencies, rated.audibilities, strict=True)
    return float(max((db for hertz, db in tones if hertz >= LOWEST_HZ), default=NO_TONE_DB))


def main():
    sounds = json.load(sys.stdin)
    rated = []
    for sound in sounds:
        decisive = [
            decisive_db(spectrum, sound["frequency_hz"], sound["step_hz"])
            for spectrum in sound["level_db"]
        ]
        mean_db = mean_audibility(decisive)
        adjustment = tonal_adjustment_from_mean_audibility(mean_db)
        rated.append({"decisive_db": decisive, "mean_db": mean_db, "adjustment_db": adjustment})
    json.dump(rated, sys.stdout)


if __name__ == "__main__":
    main()
