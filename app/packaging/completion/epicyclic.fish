# Completion of epicyclic in fish: the program itself knows what can follow.
for program in epicyclic epicyclic-mpi
    complete -c $program -f -a "($program __complete (commandline -opc)[2..-1] (commandline -ct) 2>/dev/null)"
end
