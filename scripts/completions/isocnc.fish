# Completion for fish: the programs know their options and words best.
for program in isolint isofmt isorun isodiff isols isodap
    complete -c $program -a "($program --complete $program (commandline -ct) (commandline -opc)[-1] 2>/dev/null)"
end
