;;; dap_mode.el --- Emacs' debugger, as docs/editors.md configures it: it steps an example  -*- lexical-binding: t -*-

;;; Code:

(package-initialize)
(setq lsp-session-file (expand-file-name "lsp-session" (getenv "HOME"))
      dap-breakpoints-file (expand-file-name "dap-breakpoints" (getenv "HOME")))
(load (expand-file-name "emacs.el" (getenv "HOME")))
(load (expand-file-name "dap-mode.el" (getenv "HOME")))

(load (expand-file-name "tests/clients/waiting.el" (getenv "ISOCNC_ROOT")))

;; Without a window there is nothing to show a frame in: the line is all.
(defvar isocnc-lines nil "Lines at which the machine has stopped, the last first.")
(advice-add 'dap--go-to-stack-frame :override
            (lambda (_session frame) (when frame (push (gethash "line" frame) isocnc-lines))))

(find-file (expand-file-name "examples/pocket.iso" (getenv "ISOCNC_ROOT")))
(let ((template (alist-get "ISOCNC: step the program" dap-debug-template-configurations nil nil #'equal))
      (status (expand-file-name "isodap.status" (getenv "HOME"))))
  (dap-debug (copy-tree template))
  (isocnc-wait (lambda () isocnc-lines) "the program does not stop on entry")
  (let ((first (car isocnc-lines)))
    (setq isocnc-lines nil)
    (dap-next (dap--cur-session))
    (isocnc-wait (lambda () isocnc-lines) "a step does not end")
    (unless (> (car isocnc-lines) first)
      (isocnc-fail "a step leads from line %d to line %d" first (car isocnc-lines))))
  (dap-disconnect (dap--cur-session))
  (isocnc-wait (lambda () (file-exists-p status)) "the adapter does not end"))
(set-buffer-modified-p nil)
(kill-emacs 0)

;;; dap_mode.el ends here
