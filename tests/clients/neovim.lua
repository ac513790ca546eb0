-- Neovim's own client, as docs/editors.md configures it: it opens an example, and shows what isolint finds in it.
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

client.stop()
local status = vim.env.HOME .. '/isols.status'
wait(function() return vim.fn.getfsize(status) > 0 end, 'the server does not end')
expect(vim.fn.readfile(status)[1] == '0', 'exit status ' .. vim.fn.readfile(status)[1])
vim.cmd('qall!')
