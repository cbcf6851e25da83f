"""Certificates for tests of TLS, made by the command openssl."""

import shutil
import subprocess
from pathlib import Path

import pytest

needs_openssl = pytest.mark.skipif(
    not shutil.which("openssl"), reason="the command openssl makes the certificates"
)


def certified(folder: Path) -> dict[str, Path]:
    """Make an authority and a certificate that it signed; gives the options of TLS."""
    folder.mkdir()
    elliptic = ["-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes"]
    signed = ["-CA", "ca.pem", "-CAkey", "ca_key.pem"]
    for name, signature in (("ca", []), ("cert", signed)):
        subprocess.run(
            ["openssl", "req", "-x509", *elliptic, *signature, "-subj", f"/CN={folder.name} {name}",
             "-days", "2", "-out", f"{name}.pem", "-keyout", f"{name}_key.pem",
             "-addext", f"basicConstraints=critical,CA:{str(name == 'ca').upper()}"],
            cwd=folder, check=True, capture_output=True,
        )  # fmt: skip
    return {
        "tls_ca": folder / "ca.pem",
        "tls_cert": folder / "cert.pem",
        "tls_key": folder / "cert_key.pem",
    }
