-- Neovim's own client, as docs/editors.md configures it: it opens examples, shows what isolint finds in them, and explains, follows, renames,
-- fixes and formats.
local root = vim.env.ISOCNC_ROOT

local function fail(message)
  io.stderr:write('neovim: ' .. message .. '\n')
  vim.cmd('cquit 1')
end

local function expect(condition, message)
  if not condition then fail(message) end
end

local function wait(condition, message)
  expect(vim.wait(20000, condition, 10), message)
end

vim.cmd('edit ' .. root .. '/examples/broken/pocket.iso')
local buffer = vim.api.nvim_get_current_buf()
wait(function() return #vim.lsp.get_active_clients() == 1 end, 'no client was started')
local client = vim.lsp.get_active_clients()[1]

local run = vim.fn.system({ vim.env.ISOCNC_BIN_DIR .. '/isolint', '--format', 'json', vim.api.nvim_buf_get_name(buffer) })
local expected = vim.json.decode(run)
wait(function() return #vim.diagnostic.get(buffer) == #expected end, 'findings do not come')
local found = vim.diagnostic.get(buffer)
table.sort(found, function(a, b) return a.lnum ~= b.lnum and a.lnum < b.lnum or a.lnum == b.lnum and a.col < b.col end)
for i, finding in ipairs(found) do
  expect(finding.lnum + 1 == expected[i].line, 'another line than isolint says')
  expect(finding.col + 1 == expected[i].column, 'another column than isolint says')
  expect(finding.message == expected[i].message, 'another message than isolint says')
end

-- Columns in UTF-16, behind letters that take two bytes each.
vim.api.nvim_buf_set_lines(buffer, 0, -1, false, { 'M06 T101001', '(è é €) G80', 'M02' })
wait(function() return #vim.diagnostic.get(buffer) == 1 end, 'an edit is not followed')
expect(vim.diagnostic.get(buffer)[1].col == #'(è é €) ', 'columns are wrong behind letters that are not ASCII')

-- A jump, its label, a fix.
vim.cmd('edit! ' .. root .. '/examples/broken/option.iso')
buffer = vim.api.nvim_get_current_buf()
vim.bo.swapfile = false
local function line(number) return vim.api.nvim_buf_get_lines(buffer, number - 1, number, false)[1] end
local function finds(code)
  return #vim.tbl_filter(function(each) return each.code == code end, vim.diagnostic.get(buffer)) > 0
end
wait(function() return finds('ISO043') end, 'findings of a second program do not come')

local jump = vim.fn.search('GOTO N300$')
vim.api.nvim_win_set_cursor(0, { jump, #line(jump) - 2 })
local answers = vim.lsp.buf_request_sync(buffer, 'textDocument/hover', vim.lsp.util.make_position_params(), 20000)
expect(answers[client.id].result.contents.value:find('target of a jump', 1, true), 'the hover does not tell of the label')
vim.lsp.buf.definition()
wait(function() return vim.api.nvim_win_get_cursor(0)[1] ~= jump end, 'the jump is not followed')
local label = vim.api.nvim_win_get_cursor(0)[1]
expect(line(label):find('^N300 '), 'the jump leads to ' .. line(label))
vim.lsp.buf.rename('N305')
wait(function() return line(label):find('^N305 ') and line(jump):find('GOTO N305$') end, 'label and jump are not renamed')

vim.ui.select = function(items, options, choose)
  for _, item in ipairs(items) do
    if options.format_item(item):find('put M02 on a line of its own', 1, true) then return choose(item) end
  end
  fail('the fix is not offered')
end
wait(function() return finds('ISO043') end, 'the finding is gone by itself')
local wrong = vim.fn.search('M05 M02$', 'w')
vim.api.nvim_win_set_cursor(0, { wrong, #line(wrong) - 1 })
vim.lsp.buf.code_action()
wait(function() return line(wrong + 1) == 'M02' end, 'the fix is not made')
wait(function() return not finds('ISO043') end, 'the finding stays')

vim.api.nvim_buf_set_lines(buffer, jump - 1, jump, false, { 'n170   if vgpl>=1 goto n305' })
vim.lsp.buf.formatting_sync(nil, 20000)
expect(line(jump) == 'N170 IF VGPL >= 1 GOTO N305', 'formatted: ' .. line(jump))

vim.fn.search('M06 T', 'w')
vim.cmd('Isocnc state')
wait(function() return vim.fn.search('^\\* tool ', 'w') > 0 end, 'the state is not shown')
vim.cmd('bwipeout')

client.stop()
local status = vim.env.HOME .. '/isols.status'
wait(function() return vim.fn.getfsize(status) > 0 end, 'the server does not end')
expect(vim.fn.readfile(status)[1] == '0', 'exit status ' .. vim.fn.readfile(status)[1])
vim.cmd('qall!')
