function equations(file)
  [f, facts] = epicyclic.rhs(file, 'mesh_frequency_ratio', 2.8);
  result = epicyclic.open('out');
  n = numel(facts.names);
  y = zeros(n, 2);
  for k = 1:n
    y(k, :) = result.poincare.(facts.names{k})(1:2);
  end
  [~, x] = ode45(f, [0, facts.period], y(:, 1), odeset('RelTol', 1e-9, 'AbsTol', 1e-11));
  assert(x(end, :)', y(:, 2), 1e-6);
  assert(f(0.1, [facts.start, y(:, 1)]), [f(0.1, facts.start), f(0.1, y(:, 1))]);

  refused(@() f(0, y(1:3, 1)), 'rows');
  refused(@() f(0, nan(n, 1)), 'finite');
  refused(@() f(0, 'text'), 'real numbers');
  refused(@() f(0, y(:, 1) + 1i), 'real numbers');
  refused(@() f([0, 1], y(:, 1)), 'one number');
  refused(@() epicyclic.rhs('nowhere.json'), 'no such file');
  refused(@() epicyclic.rhs(file, 'sped', 3), 'unknown key');
  refused(@() epicyclic.rhs_mex(0), 'handle');
  for k = 1:40  % each forgets its model
    g = epicyclic.rhs(file);
  end
  slower = epicyclic.rhs(file, 'sun_speed_rpm', 3000);
  assert(any(slower(0.1, facts.start) ~= g(0.1, facts.start)));
  disp('all equal');
end

function refused(call, words)
  try
    call();
  catch problem
    assert(~isempty(strfind(problem.message, words)), problem.message);
    assert(problem.identifier, 'epicyclic:input');
    return
  end
  error('not refused: %s', func2str(call));
end
