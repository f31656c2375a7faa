"""Ways in from other processes and computers: they see symbols, the mailbox and the published image, nothing else."""

from motionlayer.connect._server import ADS, ServerFailed

__all__ = ["ADS", "ServerFailed"]
