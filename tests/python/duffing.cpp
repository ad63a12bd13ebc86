// Duffing x'' + d x' - x + x^3 = g cos w t with its derivatives, as a user of ctypes has it. p = (g, d, w).
#include <cmath>

extern "C" void duffing(double t, const double* y, const double* p, double* f) {
  f[0] = y[1];
  f[1] = p[0] * std::cos(p[2] * t) - p[1] * y[1] + y[0] - y[0] * y[0] * y[0];
}

extern "C" void jacobian(double /*t*/, const double* y, const double* p, double* j) {
  j[0] = 0.0;
  j[1] = 1.0;
  j[2] = 1.0 - 3.0 * y[0] * y[0];
  j[3] = -p[1];
}
