;;; eglot.el --- Emacs' client, as docs/editors.md configures it: it opens an example, and shows what isolint finds in it  -*- lexical-binding: t -*-

;;; Code:

(package-initialize)
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

(let ((file (expand-file-name "examples/broken/pocket.iso" (getenv "ISOCNC_ROOT"))))
  (find-file file)
  (unless (eq major-mode 'isocnc-mode) (isocnc-fail "the mode is %s" major-mode))
  (let ((server (apply #'eglot (eglot--guess-contact))))
    (flymake-mode 1)
    (let ((expected (isocnc-findings file)))
      (isocnc-wait (lambda () (flymake-start) (= (length (flymake-diagnostics)) expected)) "findings do not come"))
    (let ((process (jsonrpc--process server)))
      (jsonrpc-request server :shutdown nil)
      (jsonrpc-notify server :exit nil)
      (isocnc-wait (lambda () (not (process-live-p process))) "the server does not end")
      (unless (= (process-exit-status process) 0)
        (isocnc-fail "exit status %d" (process-exit-status process)))))
  (set-buffer-modified-p nil)
  (kill-emacs 0))

;;; eglot.el ends here
