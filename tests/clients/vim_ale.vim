" Vim with ALE, as docs/editors.md configures it: it shows what isolint finds while a program is open.
source $HOME/ale.vim
runtime plugin/ale.vim

function! s:Fail(message)
  call writefile(['ale: ' . a:message], '/dev/stderr', 'a')
  cquit 1
endfunction

execute 'edit' $ISOCNC_ROOT . '/examples/broken/pocket.iso'
let s:expected = json_decode(system('isolint --format json ' . expand('%:p')))
function! s:Found()
  return sort(map(copy(ale#engine#GetLoclist(bufnr(''))), 'v:val.lnum'), 'n')
endfunction
let s:tries = 0
call ale#Queue(0)
while len(s:Found()) != len(s:expected)
  if s:tries > 400
    call s:Fail('findings do not come: ' . string(s:Found()))
  endif
  let s:tries += 1
  sleep 50m
endwhile
if s:Found() != map(copy(s:expected), 'v:val.line')
  call s:Fail('other lines than isolint says: ' . string(s:Found()))
endif
qall!
