! N oscillators in a row over smooth clearances, as chain() of branches_beside_auto.cpp, and a driver for sin and cos.
!   PAR(1) W   PAR(2) width   PAR(3) E   PAR(4) k   PAR(11) period
SUBROUTINE FUNC(NDIM, U, ICP, PAR, IJAC, F, DFDU, DFDP)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM, ICP(*), IJAC
  DOUBLE PRECISION, INTENT(IN) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(OUT) :: F(NDIM)
  DOUBLE PRECISION, INTENT(INOUT) :: DFDU(NDIM, NDIM), DFDP(NDIM, *)
  DOUBLE PRECISION w, s, p, q, x, gap, coupling, amplitude
  INTEGER i, n
  n = (NDIM - 2) / 2
  w = PAR(1); s = PAR(2)
  p = U(NDIM - 1); q = U(NDIM)
  DO i = 1, n
    x = U(i)
    gap = x + 0.5D0 * (SQRT((x - 1)**2 + s*s) - SQRT((x + 1)**2 + s*s))
    coupling = 0
    IF (i > 1) coupling = coupling + PAR(4) * (x - U(i - 1))
    IF (i < n) coupling = coupling + PAR(4) * (x - U(i + 1))
    amplitude = PAR(3) * (1 + 0.1D0 * (i - 1) / n)
    F(i) = U(n + i)
    F(n + i) = 0.1D0 + amplitude * w*w * p - 0.1D0 * U(n + i) - gap - coupling
  END DO
  F(NDIM - 1) = p + w*q - p * (p*p + q*q)
  F(NDIM) = q - w*p - q * (p*p + q*q)
END SUBROUTINE
SUBROUTINE STPNT(NDIM, U, PAR, T)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM
  DOUBLE PRECISION, INTENT(INOUT) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(IN) :: T
  PAR(1) = 0.3D0; PAR(2) = 0.05D0; PAR(3) = 0.1D0; PAR(4) = 0.5D0
  PAR(11) = 8 * ATAN(1D0) / PAR(1)
END SUBROUTINE
SUBROUTINE BCND
END SUBROUTINE
SUBROUTINE ICND
END SUBROUTINE
SUBROUTINE FOPT
END SUBROUTINE
SUBROUTINE PVLS
END SUBROUTINE
