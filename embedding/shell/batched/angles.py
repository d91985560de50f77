"""The angle of an element from a common direction about its edge, with two derivatives.

With the tangent t of the deformed edge, any vector y out of the element across it, the common direction A and the sign
s of the element, the angle is the argument of the complex number

    z = s (t x y) . A |t|  +  i [(y . A) (t . t) - (t . A) (t . y)],

since scale does not matter. Its derivatives in t and y are

    d angle = Im (dz / z),        d2 angle = Im (d2z / z - dz dz / z^2).
"""

from __future__ import annotations

import numpy as np

from embedding.shell.batched.algebra import IDENTITY, both, cross, dot, outer, turning
from embedding.shell.batched.polynomials import Array


class Angle:
    """The argument of z and its derivatives in the six components of t and y."""

    def __init__(self, t: Array, y: Array, A: Array, sign: Array) -> None:
        self.t, self.y, self.A, self.sign = t, y, A, sign
        self.length = np.sqrt(dot(t, t))
        self.volume = dot(cross(t, y), A)
        self.ta, self.ya, self.ty = dot(t, A), dot(y, A), dot(t, y)
        self.real = sign * self.volume * self.length
        self.imaginary = self.ya * self.length**2 - self.ta * self.ty
        self.square = self.real**2 + self.imaginary**2

    @property
    def value(self) -> Array:
        """The angle (p, e)."""
        return np.asarray(np.arctan2(self.imaginary, self.real))

    @property
    def length_slope(self) -> Array:
        """d|t|, shape (6, p, e)."""
        return np.concatenate([self.t / self.length, np.zeros_like(self.t)])

    @property
    def volume_slope(self) -> Array:
        """d((t x y) . A)."""
        return np.concatenate([cross(self.y, self.A), cross(self.A, self.t)])

    def slopes(self) -> tuple[Array, Array]:
        """Real and imaginary part of dz / z, each (6, p, e)."""
        real = self.sign * (self.volume * self.length_slope + self.length * self.volume_slope)
        imaginary = np.concatenate(
            [
                2 * self.ya * self.t - self.ty * self.A - self.ta * self.y,
                self.length**2 * self.A - self.ta * self.t,
            ]
        )
        r, i = self.real / self.square, self.imaginary / self.square
        return r * real + i * imaginary, r * imaginary - i * real

    def bend(self, slopes: tuple[Array, Array]) -> Array:
        """Second derivative (6, 6, p, e) of the angle, given the :meth:`slopes`."""
        real = both(self.length_slope, self.volume_slope)
        real[:3, :3] += self.volume * self.length_bend
        across = self.length * turning(self.A)
        real[:3, 3:] -= across
        real[3:, :3] += across
        out = -(self.sign * self.imaginary / self.square) * real
        r = self.real / self.square
        out[:3, :3] += r * (2 * self.ya * IDENTITY - both(self.A, self.y))
        mixed = r * (2 * outer(self.t, self.A) - outer(self.A, self.t) - self.ta * IDENTITY)
        out[:3, 3:] += mixed
        out[3:, :3] += np.swapaxes(mixed, 0, 1)
        return np.asarray(out - both(*slopes))

    @property
    def length_bend(self) -> Array:
        """d2|t| in t alone, shape (3, 3, p, e)."""
        e = self.t / self.length
        return (IDENTITY - outer(e, e)) / self.length


class Turn:
    """q = (angle_0 - angle) / |t| with its derivatives."""

    def __init__(self, start: Array, angle: Angle) -> None:
        self._angle, self._past = angle, start - angle.value
        self._slopes = angle.slopes()

    @property
    def value(self) -> Array:
        """q, shape (p, e)."""
        return np.asarray(self._past / self._angle.length)

    @property
    def slope(self) -> Array:
        """dq, shape (6, p, e)."""
        length = self._angle.length
        return np.asarray(-self._slopes[1] / length - self._past / length**2 * self._angle.length_slope)

    @property
    def bend(self) -> Array:
        """d2q, shape (6, 6, p, e)."""
        angle, length = self._angle, self._angle.length
        stretch = angle.length_slope
        out = both(self._slopes[1], stretch) / length**2 - angle.bend(self._slopes) / length
        stretch = stretch[:3]
        out[:3, :3] += self._past / length**2 * (2 * outer(stretch, stretch) / length - angle.length_bend)
        return np.asarray(out)
