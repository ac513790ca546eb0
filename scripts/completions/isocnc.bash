# Completion for bash: the programs know their options and words best.
complete -o default -o bashdefault -C 'isolint --complete' isolint
complete -o default -o bashdefault -C 'isofmt --complete' isofmt
complete -o default -o bashdefault -C 'isorun --complete' isorun
complete -o default -o bashdefault -C 'isodiff --complete' isodiff
complete -o default -o bashdefault -C 'isols --complete' isols
complete -o default -o bashdefault -C 'isodap --complete' isodap
