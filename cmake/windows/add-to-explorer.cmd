@echo off
rem Adds "Check with isolint" and "Watch with isolint" to the menus of programs and folders in the Explorer, for this user and the
rem isolint.exe beside this file. Nothing else changes: a double click on a disk image (.iso) still mounts it.
rem remove-from-explorer.cmd takes the entries away.
setlocal
set "isolint=%~dp0isolint.exe"
if not exist "%isolint%" (
  echo There is no isolint.exe beside %~nx0.
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

rem The console stays open, so that the findings can be read.
for %%k in (SystemFileAssociations\.iso SystemFileAssociations\.nc SystemFileAssociations\.cnc SystemFileAssociations\.tap SystemFileAssociations\.ngc Directory) do (
  reg add "HKCU\Software\Classes\%%k\shell\isolint" /ve /f /d "%check%" >nul
  if errorlevel 1 exit /b 1
  reg add "HKCU\Software\Classes\%%k\shell\isolint\command" /ve /f /d "cmd.exe /d /s /k \"\"%isolint%\" \"%%1\"\"" >nul
  if errorlevel 1 exit /b 1
)
reg add "HKCU\Software\Classes\Directory\shell\isolint-watch" /ve /f /d "%watch%" >nul
if errorlevel 1 exit /b 1
reg add "HKCU\Software\Classes\Directory\shell\isolint-watch\command" /ve /f /d "cmd.exe /d /s /k \"\"%isolint%\" --watch \"%%1\"\"" >nul
if errorlevel 1 exit /b 1
echo %check%
echo %watch%
