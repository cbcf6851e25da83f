"""FLAC and Sony Wave64, and packed WAV, through libsndfile."""

from typing import Final

from ...base.errors import StorageError
from ...base.registry import register
from ..claims import check_claim
from ..reader import Reader
from ..recorded import Recorded, Request, check_size
from ..riff import stated_scales
from ..wave64 import check_wave64

_BITS: Final = {"PCM_S8": 8, "PCM_U8": 8, "PCM_16": 16, "PCM_24": 24, "PCM_32": 32}
_FLAC_BLOCK: Final = 65_535
"""Most samples of a frame of FLAC (RFC 9639, 8.2)."""
_FLAC_FRAME_BYTES, _FLAC_CHANNEL_BYTES = 8, 2
"""Fewest bytes of its header and checksums, and of a channel that is constant (RFC 9639, 9)."""
_FLOATS: Final = ("FLOAT", "DOUBLE")


def read(request: Request) -> Recorded:
    """Channels `channel 1`, `channel 2` …, fractions of full scale unless stored as floats.

    Raises
    ------
    StorageError
        The file is damaged or too large.
    """
    import soundfile

    if request.path.suffix.lower() == ".w64":
        with request.path.open("rb") as wave:
            check_wave64(wave)
    with soundfile.SoundFile(str(request.path)) as file:
        rate_hz = request.sample_rate_hz or float(file.samplerate)
        names = [f"channel {number}" for number in range(1, file.channels + 1)]
        chosen = request.chosen(names)
        if file.format == "FLAC":
            frame_bytes = _FLAC_FRAME_BYTES + _FLAC_CHANNEL_BYTES * file.channels
            check_claim(request.path, file.frames, frame_bytes, ratio=_FLAC_BLOCK)
        first, last = request.part(file.frames, rate_hz)
        check_size(file.channels, last - first)
        try:
            file.seek(first)
            frames = file.read(last - first, dtype="float64", always_2d=True)
        except soundfile.LibsndfileError as error:
            raise StorageError(
                f"claims {file.frames} samples, of which {first} to {last} cannot be read: "
                f"truncated or damaged: {error}"
            ) from None
        if len(frames) != last - first:
            raise StorageError(
                f"holds {len(frames)} of {last - first} samples that it claims: it is truncated"
            )
        scales = stated_scales(file.comment, file.channels)
        bits = _BITS.get(file.subtype)
        limits = None if bits is None else (-1.0, 1.0 - 2.0 ** (1 - bits))
        return Recorded(
            names=[names[column] for column in chosen],
            units=[scales[column][1] if scales else "" for column in chosen],
            samples=[frames[:, column] for column in chosen],
            sample_rate_hz=rate_hz,
            full_scale=file.subtype not in _FLOATS,
            first_sample=first,
            total_samples=file.frames,
            limits=[limits] * len(chosen),
            calibration=[scales[column][0] if scales else None for column in chosen],
        )


register(Reader("flac", (".flac", ".w64"), "FLAC and Wave64", read, package="soundfile"))
