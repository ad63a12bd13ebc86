"""The compiled module. Its parts are for the package; users have its classes."""

from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

__version__: str

def version_text() -> str: ...
def schema_text() -> str: ...

class RightHandSide:
    """Equations of motion: f(tau, y) gives dy/dtau, of the shape of y: (dimension,) or (dimension, k)."""

    @property
    def names(self) -> List[str]: ...
    @property
    def dimension(self) -> int: ...
    @property
    def mesh_frequency_ratio(self) -> float: ...
    @property
    def omega_sn(self) -> float: ...
    @property
    def start(self) -> npt.NDArray[np.float64]: ...
    @property
    def period(self) -> float: ...
    def __call__(self, tau: float, y: Any) -> npt.NDArray[np.float64]: ...

class Input:
    @staticmethod
    def read(file: str, sets: Sequence[str]) -> Input: ...
    @staticmethod
    def parse(text: str, name: str, sets: Sequence[str]) -> Input: ...
    @property
    def resolved(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def has_dynamics(self) -> bool: ...
    def warnings(self) -> List[str]: ...
    def points(self) -> Dict[str, int]: ...
    def gear(self) -> Dict[str, Any]: ...
    def right_hand_side(self) -> RightHandSide: ...

class Drawing:
    teeth: List[int]
    profile_shifts: List[float]
    module_mm: Optional[float]
    pressure_angle_deg: Optional[float]
    width_mm: Optional[float]
    planets: Optional[int]
    angles_deg: List[float]
    torque_Nm: Optional[float]
    speed_rpm: Optional[float]
    def __init__(self) -> None: ...
    def study(self, name: str) -> str: ...

class Job:
    def __init__(
        self,
        command: str,
        input: str,
        output: str,
        threads: int,
        sets: Sequence[str],
        origins: Sequence[str],
        grow: str,
        against: str,
        rows: int,
        part: int,
        parts: int,
    ) -> None: ...
    def stop(self) -> None: ...
    def wait(self, seconds: float) -> bool: ...
    def messages(self) -> Tuple[List[str], List[str], List[str]]: ...
    def progress(self) -> Optional[Tuple[str, int, Optional[int], int]]: ...
    def rows(self) -> List[Dict[str, Any]]: ...
    def result(self) -> int: ...

class System:
    def __init__(
        self,
        n: int,
        parameters: int,
        address: int,
        callable: Any,
        jacobian_address: int,
        jacobian: Any,
        period: Any,
    ) -> None: ...
    def section(
        self, start: Any, params: Any, transient: int, periods: int, tolerance: float, longest: int
    ) -> Tuple[npt.NDArray[np.float64], int, float]: ...
    def regime(
        self, start: Any, params: Any, transient: int, budget: int, longest: int, tolerance: float
    ) -> Dict[str, Any]: ...
    def exponents(
        self, start: Any, params: Any, transient: int, aligning: int, periods: int, tolerance: float
    ) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], float, float]: ...
    def orbit(self, start: Any, params: Any, transient: int, period: int, tolerance: float) -> Dict[str, Any]: ...
    def branches(
        self,
        start: Any,
        params: Any,
        which: int,
        low: float,
        high: float,
        transient: int,
        period: int,
        largest_period: int,
        max_step: float,
        most: int,
        tolerance: float,
    ) -> List[Dict[str, Any]]: ...
