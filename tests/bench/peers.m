% Octave's ode45 on the right-hand side of peer_rhs.cpp, at equal global error; as mesh_period_at_equal_error of
% integrators.cpp, in fifths of a decade. Run by tests/bench/table:
%   octave-cli --path FOLDER_OF_peer_rhs.mex peers.m OMEGA DIGITS REPETITIONS SECONDS
% Prints right-hand sides a period, microseconds a period and the tolerance.
1;
crash_dumps_octave_core (false);

function [y, step] = mesh_period (y, step, stops, tolerance)
  s = 0;
  longest = 0;
  for k = 1:numel (stops)
    options = odeset ("RelTol", tolerance, "AbsTol", 1e-2 * tolerance, "Refine", 1, "MaxStep", stops(k) - s);
    if (step > 0)
      options = odeset (options, "InitialStep", min (step, stops(k) - s));
    endif
    solution = ode45 (@(s, y) peer_rhs (k - 1, s, y), [s, stops(k)], y, options);
    y = solution.y(:, end);
    if (abs (solution.x(end) - stops(k)) > 1e-12)  # rounding apart
      error ("ode45 did not reach the end");
    endif
    longest = max (longest, max (diff (solution.x)));
    s = stops(k);
  endfor
  step = longest;
endfunction

function e = error_at (tolerance, start, reference, stops)
  y = start;
  step = 0;
  for k = 1:20
    [y, step] = mesh_period (y, step, stops, tolerance);
  endfor
  e = log10 (max (abs (y - reference)) / max (abs (reference)));
endfunction

arguments = argv ();
omega = str2double (arguments{1});
digits = str2double (arguments{2});
repetitions = str2double (arguments{3});
seconds = str2double (arguments{4});
[start, reference, stops] = peer_rhs (omega);
stops = [stops; 2 * pi];

near = [];
for direction = [1, -1]
  k = -5 * digits - (direction < 0);
  while (k >= -65 && k <= -15)
    e = error_at (10 ^ (k / 5), start, reference, stops) + digits;
    if (abs (e) <= 1)
      near(end + 1, :) = [e, k / 5];
    endif
    if (direction * e > 1)
      break;
    endif
    k += direction;
  endwhile
endfor
if (rows (near) < 5)
  error ("too few tolerances give an error near the wanted one");
endif
line = polyfit (near(:, 1), near(:, 2), 1);
tolerance = 10 ^ line(2);

y = start;
step = 0;
least = Inf;
for repetition = 1:repetitions
  began = cputime ();
  periods = 0;
  calls = peer_rhs ();
  while (cputime () - began < seconds)
    [y, step] = mesh_period (y, step, stops, tolerance);
    periods += 1;
  endwhile
  calls = peer_rhs () - calls;
  least = min (least, (cputime () - began) / periods);
endfor
printf ("%.17g %.17g %.17g\n", calls / periods, 1e6 * least, tolerance);
