@echo off
rem Adds "Check with isolint" and "Watch with isolint" to the menus of programs, folders and drives in the Explorer, for this user and the
rem isolint.exe beside this file. Nothing else changes: a double click on a disk image (.iso) still mounts it.
rem remove-from-explorer.cmd takes the entries away.
setlocal
set failed=
set "isolint=%~dp0isolint.exe"
if not exist "%isolint%" (
  echo There is no isolint.exe beside %~nx0.
  pause
  exit /b 1
)
set "check=Check with isolint"
set "watch=Watch with isolint"
rem isolint knows the language of the user: its help begins with a word of it.
set "help=%temp%\isolint-help.txt"
"%isolint%" --help >"%help%"
set /p first=<"%help%"
del "%help%"
if "%first:~0,8%"=="Verifica" set "check=Verifica con isolint"
if "%first:~0,8%"=="Verifica" set "watch=Tieni d'occhio con isolint"

rem The console stays open, so that the findings can be read. An open folder is checked from the menu of its background, which names it by %V.
for %%k in (SystemFileAssociations\.iso SystemFileAssociations\.nc SystemFileAssociations\.cnc SystemFileAssociations\.tap SystemFileAssociations\.ngc) do (
  call :add %%k isolint "%check%" "" 1
)
rem The point keeps the \ at the end of E:\ from the quote after it.
call :add Directory isolint "%check%" "" 1
call :add Directory isolint-watch "%watch%" " --watch" 1
call :add Drive isolint "%check%" "" 1.
call :add Drive isolint-watch "%watch%" " --watch" 1.
call :add Directory\Background isolint "%check%" "" V\.
call :add Directory\Background isolint-watch "%watch%" " --watch" V\.
if defined failed (
  pause
  exit /b 1
)
echo %check%
echo %watch%
rem A window that a double click has opened would close before its text is read.
pause
exit /b 0

rem CLASS VERB TEXT OPTION NAME: what the menu of a class shows, and runs with the file or folder that the Explorer calls %NAME.
:add
reg add "HKCU\Software\Classes\%1\shell\%2" /ve /f /d "%~3" >nul
if errorlevel 1 set failed=1
reg add "HKCU\Software\Classes\%1\shell\%2\command" /ve /f /d "cmd.exe /d /s /k \"\"%isolint%\"%~4 \"%%%5\"\"" >nul
if errorlevel 1 set failed=1
goto :eof
