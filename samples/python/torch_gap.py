#!/usr/bin/env python3
"""The gap as a function of PyTorch, with its gradient: gradcheck, and a heap of overlapping bodies that Adam takes apart.

    torch_gap.py

The backward pass takes the normals and witness points that the gaps came with. It costs no query, and needs no PyTorch in the
library. A query computes in double precision on the processor.
"""

from __future__ import annotations

from typing import Any, Tuple

import numpy as np
import supernormal as sn
import torch
from planner import left_jacobian
from scipy.spatial.transform import Rotation

BODY = sn.Superellipsoid((0.3, 0.2, 0.15), 4, 2.5)


class Gap(torch.autograd.Function):  # type: ignore[misc]
    """The gaps of N pairs of BODY: (N,), m, from two tensors of poses (N, 6), a position in m and a rotation vector."""

    @staticmethod
    def forward(context: Any, first: torch.Tensor, second: torch.Tensor) -> torch.Tensor:
        poses = [pose.detach().numpy() for pose in (first, second)]
        places = [sn.Poses(pose[:, :3], Rotation.from_rotvec(pose[:, 3:]).as_matrix()) for pose in poses]
        found = sn.find_proximities(BODY, places[0], BODY, places[1], sn.Settings(tolerance=1e-12))
        gradients = []
        for sign, pose, point in ((-1, poses[0], found.point1), (1, poses[1], found.point2)):
            torque = np.cross(point - pose[:, :3], found.normal)
            turned = (torque[:, None] @ left_jacobian(pose[:, 3:]))[:, 0]
            gradients.append(torch.from_numpy(sign * np.hstack([found.normal, turned])))
        context.save_for_backward(*gradients)
        return torch.from_numpy(found.gap)

    @staticmethod
    def backward(context: Any, upstream: torch.Tensor) -> Tuple[torch.Tensor, torch.Tensor]:
        first, second = context.saved_tensors
        return upstream[:, None] * first, upstream[:, None] * second


def main() -> None:
    torch.manual_seed(1)
    first, second = ((0.3 * torch.randn(50, 6, dtype=torch.float64)).requires_grad_() for _ in range(2))
    gaps = Gap.apply(first, second)
    assert torch.autograd.gradcheck(Gap.apply, (first, second), eps=1e-6, atol=1e-6)
    print(f"gradcheck: passed for {len(gaps)} pairs, {int((gaps < 0).sum())} of them overlapped")

    # %% Bodies in a heap repel each other until none overlaps
    count = 30
    poses = (0.25 * torch.randn(count, 6, dtype=torch.float64)).requires_grad_()
    one, other = torch.triu_indices(count, count, 1)
    adam = torch.optim.Adam([poses], lr=0.01)
    for step in range(1000):
        overlap = torch.relu(0.001 - Gap.apply(poses[one], poses[other]))
        if step == 0:
            print(f"at first {int((overlap > 0.001).sum())} of {len(one)} pairs overlap, the deepest by {float(overlap.max()):.3f} m")
        if float(overlap.max()) < 0.001:
            break
        adam.zero_grad()
        (overlap**2).sum().backward()
        adam.step()
    deepest = float(overlap.max()) - 0.001
    print(f"after {step} steps of Adam {int((overlap > 0.001).sum())} overlap, the deepest by {max(deepest, 0.0):.4f} m")


if __name__ == "__main__":
    main()
