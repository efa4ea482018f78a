"""systemd's files: what stands in them, and which keys systemd 252 (Debian 12) knows."""
# SPDX-License-Identifier: Apache-2.0
import re
from collections import defaultdict
from pathlib import Path

# From systemd.unit(5), .service(5), .exec(5), .kill(5), .network(5) and .link(5) of version 252:
# the keys that we write. A key that is not here is a mistake or has to be looked up and added.
KNOWN = {
    ".service": {
        "Unit": "Description BindsTo After Before Wants StartLimitIntervalSec StartLimitBurst",
        "Service":
            "Type User EnvironmentFile StateDirectory LoadCredential ExecStart ExecStop "
            "RemainAfterExit Restart RestartSec RestartPreventExitStatus TimeoutStopSec "
            "LimitRTPRIO LimitMEMLOCK "
            "OOMScoreAdjust AmbientCapabilities CapabilityBoundingSet NoNewPrivileges "
            "ProtectSystem ProtectHome PrivateTmp PrivateDevices ProtectProc ProtectClock "
            "ProtectHostname ProtectKernelTunables ProtectKernelModules ProtectKernelLogs "
            "ProtectControlGroups RestrictAddressFamilies RestrictNamespaces RestrictSUIDSGID "
            "LockPersonality MemoryDenyWriteExecute SystemCallArchitectures SystemCallFilter "
            "SystemCallErrorNumber UMask SupplementaryGroups DevicePolicy DeviceAllow",
        "Install": "WantedBy",
    },
    ".network": {"Match": "Name", "Link": "RequiredForOnline",
                 "CAN": "BitRate RestartSec ListenOnly"},
    ".link": {"Match": "OriginalName", "Link": "NamePolicy TransmitQueueLength"},
}

# Where systemd is installed, its own table of keys is the judge of those of .network as well.
NETWORKD = Path("/lib/systemd/systemd-networkd")


def read(text):
    """{(section, key): [values]}"""
    found, section = defaultdict(list), None
    for line in re.sub(r"\s*\\\n\s*", " ", text).splitlines():
        if not line or line.startswith("#"):
            continue
        if line.startswith("["):
            section = line.strip("[]")
        else:
            key, value = line.split("=", 1)
            found[section, key].append(value)
    return found


def unknown_keys(root):
    unknown = []
    networkd = NETWORKD.read_bytes() if NETWORKD.exists() else None
    for path in sorted((root / "etc/systemd").rglob("70-pitwall-*")) + \
            sorted((root / "etc/systemd").rglob("pitwall-*.service")) + \
            sorted((root / "etc/systemd").rglob("pitwall-*.service.d/*.conf")):
        if path.is_symlink():
            continue
        for section, key in read(path.read_text()):
            name = f"{section}.{key}"
            kind = path.parent.suffixes[0] if path.suffix == ".conf" else path.suffix
            known = key in KNOWN[kind].get(section, "").split()
            if networkd and path.suffix == ".network":
                known = known and name.encode() + b"\0" in networkd
            if not known:
                unknown.append(name)
    return unknown
