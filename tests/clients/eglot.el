;;; eglot.el --- Emacs' client, as docs/editors.md configures it: it opens examples, shows, explains, follows, renames, fixes, formats  -*- lexical-binding: t -*-

;;; Code:

(package-initialize)
(require 'cl-lib)
(require 'eglot)
(require 'json)

(load (expand-file-name "emacs.el" (getenv "HOME")))
(setq eglot-sync-connect 20)

(load (expand-file-name "tests/clients/waiting.el" (getenv "ISOCNC_ROOT")))

(defun isocnc-findings (file)
  "How many findings isolint has for FILE."
  (with-temp-buffer
    (call-process "isolint" nil '(t nil) nil "--format" "json" file)
    (goto-char (point-min))
    (length (json-read))))

(defun isocnc-finds (text)
  "Whether a finding that says TEXT is shown."
  (flymake-start)
  (seq-some (lambda (each) (string-match-p text (flymake-diagnostic-text each))) (flymake-diagnostics)))

(defun isocnc-line-is (regexp)
  "Whether the line at point, as a whole, matches REGEXP."
  (save-excursion (beginning-of-line) (looking-at (concat regexp "$"))))

(defun isocnc-choose-action (title)
  "Choose the code action at point that has this TITLE."
  (let ((last-nonmenu-event ?x))
    (cl-letf (((symbol-function 'completing-read)
               (lambda (_prompt actions &rest _)
                 (or (car (seq-find (lambda (each) (string-match-p title (car each))) actions))
                     (isocnc-fail "no action is called %s" title)))))
      (eglot-code-actions (point) nil nil t))))

(defun isocnc-try-features ()
  "Explain, follow and rename a jump, fix a finding and format, in the present buffer."
  (isocnc-wait (lambda () (isocnc-finds "M02 must stand alone")) "findings of a second program do not come")
  (goto-char (point-min))
  (search-forward "GOTO N30")
  (let* ((jump (line-number-at-pos))
         (hover (jsonrpc-request (eglot-current-server) :textDocument/hover (eglot--TextDocumentPositionParams)))
         (told (plist-get (plist-get hover :contents) :value)))
    (unless (string-match-p "target of a jump" told) (isocnc-fail "the hover tells: %s" told))
    (xref-find-definitions "N300")
    (unless (isocnc-line-is "N300 .*") (isocnc-fail "the jump leads to line %d" (line-number-at-pos)))
    (eglot-rename "N305")
    (unless (isocnc-line-is "N305 .*") (isocnc-fail "the label is not renamed"))
    (goto-char (point-min))
    (forward-line (1- jump))
    (unless (isocnc-line-is ".*GOTO N305") (isocnc-fail "the jump is not renamed"))
    (search-forward "M05 M02")
    (backward-char)
    (isocnc-choose-action "put M02 on a line of its own")
    (unless (save-excursion (goto-char (point-min)) (re-search-forward "^M02$" nil t))
      (isocnc-fail "the fix is not made"))
    (eglot--signal-textDocument/didChange)  ; In batch mode Emacs is never idle.
    (isocnc-wait (lambda () (not (isocnc-finds "M02 must stand alone"))) "the finding stays")
    (goto-char (point-min))
    (forward-line (1- jump))
    (delete-region (point) (line-end-position))
    (insert "n170   if vgpl>=1 goto n305")
    (eglot-format-buffer)
    (goto-char (point-min))
    (forward-line (1- jump))
    (unless (isocnc-line-is "N170 IF VGPL >= 1 GOTO N305") (isocnc-fail "the line is not formatted"))))

(let ((file (expand-file-name "examples/broken/pocket.iso" (getenv "ISOCNC_ROOT"))))
  (find-file file)
  (unless (eq major-mode 'isocnc-mode) (isocnc-fail "the mode is %s" major-mode))
  (let ((server (apply #'eglot (eglot--guess-contact))))
    (flymake-mode 1)
    (let ((expected (isocnc-findings file)))
      (isocnc-wait (lambda () (flymake-start) (= (length (flymake-diagnostics)) expected)) "findings do not come"))
    (set-buffer-modified-p nil)
    (find-file (expand-file-name "examples/broken/option.iso" (getenv "ISOCNC_ROOT")))
    (flymake-mode 1)
    (isocnc-try-features)
    (set-buffer-modified-p nil)
    (let ((process (jsonrpc--process server)))
      (jsonrpc-request server :shutdown nil)
      (jsonrpc-notify server :exit nil)
      (isocnc-wait (lambda () (not (process-live-p process))) "the server does not end")
      (unless (= (process-exit-status process) 0)
        (isocnc-fail "exit status %d" (process-exit-status process)))))
  (set-buffer-modified-p nil)
  (kill-emacs 0))

;;; eglot.el ends here
