@echo off
rem Takes away what add-to-explorer.cmd has added to the menus of the Explorer, as far as it is there.
setlocal
for %%k in (SystemFileAssociations\.iso SystemFileAssociations\.nc SystemFileAssociations\.cnc SystemFileAssociations\.tap SystemFileAssociations\.ngc Directory Drive Directory\Background) do (
  for %%e in (isolint isolint-watch) do (
    reg delete "HKCU\Software\Classes\%%k\shell\%%e" /f >nul 2>&1
  )
)
exit /b 0
