"""Text and hash that are the same for the same content."""

import hashlib
import json
from typing import Any, BinaryIO


def canonical_json(value: Any) -> str:
    """ASCII JSON with sorted keys: the same text for the same content."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def sha256(content: bytes) -> str:
    """SHA-256 of the content, in hexadecimal."""
    return hashlib.sha256(content).hexdigest()


def file_sha256(file: BinaryIO) -> str:
    """SHA-256 of the rest of an open file, in hexadecimal."""
    return hashlib.file_digest(file, "sha256").hexdigest()  # type: ignore[arg-type]
