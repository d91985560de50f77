"""One HDF5 file a run: fields that viewers open, and beside them everything that explains and reproduces
the run."""

from embedding.archive.reader import Archive, ArchivedBlock, open_archive
from embedding.archive.recorder import Recorder
from embedding.archive.repair import repair, salvage
from embedding.archive.verification import Verification, verify

__all__ = ["Archive", "ArchivedBlock", "Recorder", "Verification", "open_archive", "repair", "salvage", "verify"]
