" Vim without plugins, as docs/editors.md configures it: :make lists what isolint finds, gq formats.
function! s:Fail(message)
  call writefile(['vim: ' . a:message], '/dev/stderr', 'a')
  cquit 1
endfunction

execute 'edit' $ISOCNC_ROOT . '/examples/broken/pocket.iso'
let s:expected = json_decode(system('isolint --format json ' . expand('%:p')))
silent make
let s:found = getqflist()
if len(s:found) != len(s:expected)
  call s:Fail(len(s:found) . ' entries for ' . len(s:expected) . ' findings')
endif
for s:i in range(len(s:found))
  let [s:entry, s:finding] = [s:found[s:i], s:expected[s:i]]
  if !s:entry.valid || s:entry.lnum != s:finding.line || s:entry.col != s:finding.column
    call s:Fail('not where isolint says: ' . string(s:entry))
  endif
  if s:entry.type !=? s:finding.severity[0]
    call s:Fail('another severity: ' . string(s:entry))
  endif
endfor

new part.iso
call setline(1, ['g1x5 y 2', 'm02'])
normal! gggqG
if getline(1, '$') != ['G1 X5 Y2', 'M02']
  call s:Fail('gq leaves ' . string(getline(1, '$')))
endif
qall!
