;;; dap_mode.el --- Emacs' debugger, as docs/editors.md configures it: it steps an example, to a breakpoint and into a block  -*- lexical-binding: t -*-

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
  (goto-char (point-min))
  (search-forward "G03")
  (let ((line (line-number-at-pos)))
    (dap-breakpoint-add)
    (dolist (walk '((dap-continue 0) (dap-step-in 0) (dap-step-in 1)))
      (setq isocnc-lines nil)
      (if (eq (car walk) 'dap-continue)
          (dap-continue (dap--cur-session) 1)
        (funcall (car walk) (dap--cur-session)))
      (isocnc-wait (lambda () isocnc-lines) (format "%s does not end" (car walk)))
      (unless (= (car isocnc-lines) (+ line (cadr walk)))
        (isocnc-fail "%s leads to line %d, not %d" (car walk) (car isocnc-lines) (+ line (cadr walk))))))
  (dap-disconnect (dap--cur-session))
  (isocnc-wait (lambda () (file-exists-p status)) "the adapter does not end"))
(set-buffer-modified-p nil)
(kill-emacs 0)

;;; dap_mode.el ends here
